#version 460
// How torn the water is: lengths of mean normals, smoothed over a spacing and a half of all the
// fluid that is seen to each side, whatever its depth, one dimension of it. So it changes from
// place to place, not from drop to drop. Directions stay.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(std430, set = 0, binding = 1) readonly buffer Before { uint before[]; };     // packed
layout(std430, set = 0, binding = 2) writeonly buffer After { uint after[]; };      // packed; where there is fluid
layout(std430, set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
#define BLOCKS 4
#include "render/surface_block.glsl"
#include "render/surface_mean.glsl"
layout(constant_id = 0) const uint kVertical = 0u;

const float kReach = 1.5;  // spacings

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const uvec2 own = samples[index];
  if (own.x == kInfiniteBits) return;
  const float z = uintBitsToFloat(own.x);
  if (z <= nearestDrawn()) {
    after[index] = before[index];
    return;
  }
  const Taps taps = tapsOver(kReach, z);
  const ivec2 along = ivec2(1 - int(kVertical), int(kVertical)) * taps.stride;
  const vec3 mean = unpackMean(before[index]);
  const float size = length(mean);
  float sum = size, weights = 1.0;
  RILL_LOOP for (int k = 1; k <= kTaps; ++k) {
    const float inside = tapWeight(taps, k);
    RILL_LOOP for (int s = -1; s <= 1; s += 2) {
      const ivec2 there = p + s * k * along;
      if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, grid))) continue;
      const uint at = uint(there.y * grid.x + there.x);
      if (samples[at].x == kInfiniteBits) continue;
      sum += inside * length(unpackMean(before[at]));
      weights += inside;
    }
  }
  after[index] = packMean(size > 1e-3 ? mean * (sum / (weights * size)) : vec3(0.0));
}
