#version 460
// The domain's edges on the screen.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) writeonly buffer Edges { EdgeRecord edges[]; };

vec3 edgeEnd(uint edge, float along) {
  const uint axis = edge / 4u;
  const vec2 other = vec2(float(edge & 1u), float((edge >> 1) & 1u));
  const vec3 part = axis == 0u ? vec3(along, other) : (axis == 1u ? vec3(other.x, along, other.y) : vec3(other, along));
  return viewPoint(mix(scene.domain_min.xyz, scene.domain_max.xyz, part));
}

EdgeRecord edgeRecord(uint edge) {
  EdgeRecord record = EdgeRecord(vec4(0.0), vec4(0.0), vec4(0.0));
  vec3 a = edgeEnd(edge, 0.0), b = edgeEnd(edge, 1.0);
  if (scene.domain_min.w == 0.0 || max(a.z, b.z) <= view.near_depth) return record;
  if (a.z < view.near_depth) a = mix(a, b, (view.near_depth - a.z) / (b.z - a.z));
  if (b.z < view.near_depth) b = mix(b, a, (view.near_depth - b.z) / (a.z - b.z));
  const vec2 from = pixelOf(a.xy / a.z), to = pixelOf(b.xy / b.z);
  const float size = length(to - from);
  if (!(size > 1e-3)) return record;
  const vec2 direction = (to - from) / size, normal = vec2(-direction.y, direction.x);
  const float start = dot(direction, from);
  record.line = vec4(normal, -dot(normal, from), 1.0);
  record.along = vec4(direction, start, start + size);
  record.depth = vec4(1.0 / a.z, (1.0 / b.z - 1.0 / a.z) / size, 0.0, 0.0);
  return record;
}

void main() {
  const uint i = gl_LocalInvocationIndex;
  if (i < kEdges) edges[i] = edgeRecord(i);
}
