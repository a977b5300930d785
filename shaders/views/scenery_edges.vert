#version 460
// The domain's edges as lines of constant width.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "views/particle_records.h"

layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(location = 0) out float across;  // pixels from the line's middle
layout(location = 1) flat out float half_width;

void main() {
  const int axis = gl_InstanceIndex / 4, which = gl_InstanceIndex % 4;
  vec3 low = vec3(0.0), high = vec3(0.0);
  const vec3 choice = axis == 0 ? vec3(0.0, which & 1, which >> 1)
                                : (axis == 1 ? vec3(which & 1, 0.0, which >> 1) : vec3(which & 1, which >> 1, 0.0));
  low = choice;
  high = choice + (axis == 0 ? vec3(1.0, 0.0, 0.0) : (axis == 1 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0)));
  vec3 a = viewPoint(mix(scene.domain_min.xyz, scene.domain_max.xyz, low));
  vec3 b = viewPoint(mix(scene.domain_min.xyz, scene.domain_max.xyz, high));
  // The part in front of the eye.
  const float near = max(view.near_depth, 1e-3 * abs(b.z - a.z));
  if (a.z < near && b.z < near) {
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);
    return;
  }
  if (a.z < near) a = mix(a, b, (near - a.z) / (b.z - a.z));
  if (b.z < near) b = mix(b, a, (near - b.z) / (a.z - b.z));
  const vec2 from = pixelOf(a), to = pixelOf(b);
  const vec2 along = length(to - from) > 1e-3 ? normalize(to - from) : vec2(1.0, 0.0);
  const int n = gl_VertexIndex;
  const int corner = n < 3 ? n : (n == 3 ? 2 : (n == 4 ? 1 : 3));
  half_width = max(0.55, float(view.height) / 1400.0);
  across = (half_width + 1.0) * ((corner & 1) == 0 ? -1.0 : 1.0);
  const vec3 end = (corner & 2) == 0 ? a : b;
  const vec4 clip = clipPoint(end);
  gl_Position = clip + vec4(vec2(-along.y, along.x) * across / pictureSize() * 2.0 * clip.w, 0.0, 0.0);
}
