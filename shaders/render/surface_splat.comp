#version 460
// Depth before smoothing: the nearest sphere at each sample.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#include "render/surface.glsl"
#include "shared/atomic_load.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Survivors { uint survivors[]; };
layout(std430, set = 0, binding = 3) buffer Depth { uint depth[]; };

void visitSample(vec3 center, float radius, ivec2 p) {
  const float t = sphereDepth(center, radius, axisOf(samplePixel(p)));
  if (t < 0.0) return;
  const uint at = uint(p.y) * sampleGrid().x + uint(p.x);
  const uint bits = floatBitsToUint(t);
  if (bits < ATOMIC_LOAD(depth[at])) atomicMin(depth[at], bits);
}
void beginVisit(uint owner) {}
void endVisit(uint owner) {}
#include "render/surface_visit.glsl"

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  const bool live = k < counters[kSurvivorCount];
  const vec3 center = live ? viewPoint(position[survivors[k]].xyz) : vec3(0.0);
  visitSphere(live, center, hardRadius(center.z));
}
