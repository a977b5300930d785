#version 460
// Poses of the solids at the frame's time; of driven ones, where the fluid has them.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Solids { SolidRecord solids[]; };
layout(std430, set = 0, binding = 2) readonly buffer Keyframes { vec4 keyframes[]; };  // xyz: translation, w: time
layout(constant_id = 0) const uint FLUID_SOLID_FLOATS = 0;  // of the fluid's record of a solid, whose center comes first; 0: none is driven
layout(std430, set = 0, binding = 4) readonly buffer FluidSolids { float fluidSolids[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Poses { PoseRecord poses[]; };

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

void main() {
  const uint i = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  if (i >= scene.counts.x) return;
  const SolidRecord solid = solids[i];
  vec3 center = solid.center.xyz + translation(solid.motion.x, solid.motion.y);
  if (FLUID_SOLID_FLOATS > 0u && solid.motion.z != 0u) {
    const uint at = i * FLUID_SOLID_FLOATS;
    center = vec3(fluidSolids[at], fluidSolids[at + 1u], fluidSolids[at + 2u]) + vec3(view.offset[0], view.offset[1], view.offset[2]);
  }
  PoseRecord pose;
  pose.center = vec4(center, solid.center.w);
  pose.axis_x = vec4(turned(solid.rotation, vec3(1.0, 0.0, 0.0)), solid.half_size.x);
  pose.axis_y = vec4(turned(solid.rotation, vec3(0.0, 1.0, 0.0)), solid.half_size.y);
  pose.axis_z = vec4(turned(solid.rotation, vec3(0.0, 0.0, 1.0)), solid.half_size.z);
  pose.view = vec4(viewPoint(center), solid.half_size.w);
  poses[i] = pose;
}
