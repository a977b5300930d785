#version 460
// The mean of the normals within two spacings of a sample, one dimension of it. It is the shorter the more they differ.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Before { uvec2 before[]; };  // depth; a normal, or a packed mean
layout(std430, set = 0, binding = 1) writeonly buffer After { uvec2 after[]; };   // depth; the mean, packed
layout(std430, set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
#define BLOCKS 3
#include "render/surface_block.glsl"
#include "render/surface_mean.glsl"
layout(constant_id = 0) const uint kVertical = 0u;

const float kReach = 2.0;      // spacings
const int kTaps = 6;           // a side; where samples lie closer than that, every second or third one is looked at
const float kSameWater = 4.0;  // spacings of depth between faces of one piece of water

vec3 faceOf(uint packed) { return kVertical == 1u ? unpackMean(packed) : unpackNormal(packed); }

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uvec2 own = before[uint(p.y * grid.x + p.x)];
  if (own.x == kInfiniteBits) return;
  const float z = uintBitsToFloat(own.x);
  const float length = metresAPixel(z) * float(view.step) / view.spacing;  // of a sample's side, spacings
  const int stride = clamp(int(kReach / (length * float(kTaps)) + 0.5), 1, 1024);
  const ivec2 along = ivec2(1 - int(kVertical), int(kVertical)) * stride;
  const float apart = length * float(stride) / kReach;
  vec3 sum = faceOf(own.y);
  float weights = 1.0;
  RILL_LOOP for (int k = 1; k <= kTaps; ++k) {
    const float off = float(k) * apart, inside = max(1.0 - off * off, 0.0);
    RILL_LOOP for (int s = -1; s <= 1; s += 2) {
      const ivec2 there = p + s * k * along;
      if (any(lessThan(there, ivec2(0))) || any(greaterThanEqual(there, grid))) continue;
      const uvec2 other = before[uint(there.y * grid.x + there.x)];
      const float behind = (uintBitsToFloat(other.x) - z) / (kSameWater * view.spacing);
      const float same = max(1.0 - behind * behind, 0.0);  // nothing where there is no fluid: infinite
      const float w = inside * inside * same;
      weights += inside * inside;
      if (w > 0.0) sum += w * faceOf(other.y);
    }
  }
  after[uint(p.y * grid.x + p.x)] = uvec2(own.x, packMean(sum / weights));
}
