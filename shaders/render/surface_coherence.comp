#version 460
// Smooths the coherence, the length of mean normals, over 1.5 spacings to each side at any depth, one dimension of it, so that it does
// not jump between drops. Directions are kept.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(std430, set = 0, binding = 1) readonly buffer Before { uint before[]; };     // packed
layout(std430, set = 0, binding = 2) writeonly buffer After { uint after[]; };      // packed; where neighbor is fluid
layout(std430, set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
#define BLOCKS 4
#include "render/surface_block.glsl"
#include "render/surface_mean_normal.glsl"
layout(constant_id = 0) const bool VERTICAL = false;

const float kReach = 1.5;  // spacings

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const uvec2 own = samples[index];
  if (own.x == kNoDepthBits) return;
  const float z = uintBitsToFloat(own.x);
  if (z <= nearestDrawn()) {
    after[index] = before[index];
    return;
  }
  const Taps taps = tapsOver(kReach, z);
  const ivec2 along = ivec2(1 - int(VERTICAL), int(VERTICAL)) * taps.stride;
  const vec3 mean = unpackMean(before[index]);
  const float size = length(mean);
  float sum = size, weights = 1.0;
  RILL_LOOP for (int k = 1; k <= kTaps; ++k) {
    const float inside = tapWeight(taps, k);
    RILL_LOOP for (int s = -1; s <= 1; s += 2) {
      const ivec2 neighbor = p + s * k * along;
      if (any(lessThan(neighbor, ivec2(0))) || any(greaterThanEqual(neighbor, grid))) continue;
      const uint at = uint(neighbor.y * grid.x + neighbor.x);
      if (samples[at].x == kNoDepthBits) continue;
      sum += inside * length(unpackMean(before[at]));
      weights += inside;
    }
  }
  after[index] = packMean(size > 1e-3 ? mean * (sum / (weights * size)) : vec3(0.0));
}
