#version 460
// The mean of the normals of a square of two spacings to each side, one dimension of it. It is the shorter the more they differ.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(std430, set = 0, binding = 1) readonly buffer Before { uint before[]; };     // of the first dimension, packed
layout(std430, set = 0, binding = 2) writeonly buffer After { uint after[]; };      // packed; where there is fluid
layout(std430, set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
#define BLOCKS 4
#include "render/surface_block.glsl"
#include "render/surface_mean.glsl"
layout(constant_id = 0) const uint kVertical = 0u;

const float kReach = 2.0;  // spacings

vec3 faceAt(uint index, uvec2 stored) { return kVertical == 1u ? unpackMean(before[index]) : unpackNormal(stored.y); }

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const uvec2 own = samples[index];
  if (own.x == kInfiniteBits) return;
  const float z = uintBitsToFloat(own.x), spacing = spacingAt(z);
  if (z <= nearestDrawn()) {  // cut by the near plane: what the eye looks through, not a face
    after[index] = packMean(unpackNormal(own.y));
    return;
  }
  const Taps taps = tapsOver(kReach, z);
  const ivec2 along = ivec2(1 - int(kVertical), int(kVertical)) * taps.stride;
  const vec3 sight = normalize(rayAlong(axisOf(samplePixel(p))));
  const vec3 normal = unpackNormal(own.y);
  vec3 sum = faceAt(index, own);
  float weights = 1.0;
  RILL_LOOP for (int k = 1; k <= kTaps; ++k) {
    const float inside = tapWeight(taps, k), across = float(k) * taps.apart * kReach * spacing;
    RILL_LOOP for (int s = -1; s <= 1; s += 2) {
      const ivec2 there = p + s * k * along;
      if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, grid))) continue;
      const uint at = uint(there.y * grid.x + there.x);
      const uvec2 other = samples[at];
      const float w = inside * sameWater(uintBitsToFloat(other.x) - z, changeOf(spacing, across, normal, sight));
      weights += inside;
      if (w > 0.0) sum += w * faceAt(at, other);
    }
  }
  after[index] = packMean(sum / weights);
}
