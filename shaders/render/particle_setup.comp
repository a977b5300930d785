#version 460
// Poses of the solids at the frame's time, and the domain's edges on the screen.
#extension GL_GOOGLE_include_directive : require
#include "render/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Solids { SolidRecord solids[]; };
layout(std430, set = 0, binding = 2) readonly buffer Keyframes { vec4 keyframes[]; };  // xyz: translation, w: time
layout(std430, set = 0, binding = 3) writeonly buffer Poses { PoseRecord poses[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Edges { EdgeRecord edges[]; };

vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

vec3 translation(uint first, uint count) {
  if (count == 0u) return vec3(0.0);
  uint low = 0u, high = count;  // the first keyframe later than now is in low .. high
  while (low < high) {
    const uint middle = (low + high) / 2u;
    if (keyframes[first + middle].w <= view.time) low = middle + 1u; else high = middle;
  }
  if (low == 0u) return keyframes[first].xyz;
  if (low == count) return keyframes[first + count - 1u].xyz;
  const vec4 a = keyframes[first + low - 1u], b = keyframes[first + low];
  return mix(a.xyz, b.xyz, (view.time - a.w) / (b.w - a.w));
}

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
  const uint i = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  if (i < kEdges) edges[i] = edgeRecord(i);
  if (i >= scene.counts.x) return;
  const SolidRecord solid = solids[i];
  const vec3 centre = solid.centre.xyz + translation(solid.motion.x, solid.motion.y);
  PoseRecord pose;
  pose.centre = vec4(centre, solid.centre.w);
  pose.axis_x = vec4(turned(solid.rotation, vec3(1.0, 0.0, 0.0)), solid.half_size.x);
  pose.axis_y = vec4(turned(solid.rotation, vec3(0.0, 1.0, 0.0)), solid.half_size.y);
  pose.axis_z = vec4(turned(solid.rotation, vec3(0.0, 0.0, 1.0)), solid.half_size.z);
  pose.view = vec4(viewPoint(centre), solid.half_size.w);
  poses[i] = pose;
}
