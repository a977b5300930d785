#version 460
// A solid where the pixel's ray meets it; with LIGHT its depth alone, for the shadow map.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "views/particle_records.h"
#include "render/look_records.h"

#ifdef LIGHT
layout(std430, set = 0, binding = 0) readonly buffer Placed { PlacedSolid placed[]; };
#else
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std140, set = 0, binding = 1) uniform Look { LookRecord look; };
layout(std430, set = 0, binding = 4) readonly buffer Placed { PlacedSolid placed[]; };
#include "views/scenery.glsl"
#include "views/scenery_lit.glsl"
layout(location = 0) out vec4 color;
#endif
#include "views/particle_solids.glsl"
layout(location = 0) flat in uint index;

void main() {
  const vec2 axis = axisOf(gl_FragCoord.xy - vec2(view.left, view.top));
  const vec3 from = worldPoint(rayFrom(axis)), ray = worldDirection(rayAlong(axis));
  vec3 normal;
  const float z = solidHit(placed[index], from, ray, normal);
#ifdef LIGHT
  if (z < 0.0) discard;  // a miss: depth counts from a plane that all solids are behind
#else
  if (!(z > view.near_depth)) discard;
#endif
  gl_FragDepth = clamp(targetDepth(z), 0.0, 1.0);
#ifndef LIGHT
  color = vec4(litSolid(from + z * ray, normal, kSolidAlbedo), 1.0);
#endif
}
