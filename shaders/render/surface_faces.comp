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
const int kTaps = 6;       // a side; where samples lie closer than that, every second or third one is looked at

vec3 faceAt(uint index, uvec2 stored) { return kVertical == 1u ? unpackMean(before[index]) : unpackNormal(stored.y); }

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const uvec2 own = samples[index];
  if (own.x == kInfiniteBits) return;
  const float z = uintBitsToFloat(own.x), spacing = spacingAt(z);
  const float length = max(metresAPixel(z) * float(view.step) / spacing, 1e-3);  // of a sample's side, spacings
  const int stride = int(max(kReach / (length * float(kTaps)) + 0.5, 1.0));
  const ivec2 along = ivec2(1 - int(kVertical), int(kVertical)) * stride;
  const float apart = length * float(stride);
  const vec3 sight = normalize(rayAlong(axisOf(samplePixel(p))));
  const vec3 normal = unpackNormal(own.y);
  vec3 sum = faceAt(index, own);
  float weights = 1.0;
  RILL_LOOP for (int k = 1; k <= kTaps; ++k) {
    const float off = float(k) * apart / kReach, inside = max(1.0 - off * off, 0.0);
    RILL_LOOP for (int s = -1; s <= 1; s += 2) {
      const ivec2 there = p + s * k * along;
      if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, grid))) continue;
      const uint at = uint(there.y * grid.x + there.x);
      const uvec2 other = samples[at];
      const float w = inside * inside * sameWater(uintBitsToFloat(other.x) - z, changeOf(spacing, float(k) * apart * spacing, normal, sight));
      weights += inside * inside;
      if (w > 0.0) sum += w * faceAt(at, other);
    }
  }
  after[index] = packMean(sum / weights);
}
