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
  const vec3 p = from + z * ray;
  const float facing = max(dot(normal, scene.light_to.xyz), 0.0);
  const float bias = scene.light_texel.x * (1.0 + 2.0 * sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.1));
  const vec3 sunlight = kSun * facing * pastSolids(p, bias) * throughFluid(p);
  const vec3 albedo = vec3(0.66, 0.50, 0.36);
  color = vec4(albedo * (0.55 * skyLight(normal) + 0.85 * sunlight), 1.0);
#endif
}
