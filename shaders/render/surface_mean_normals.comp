#version 460
// Mean normal over two spacings to each side, one dimension of it; the more the normals differ, the shorter it is. VERTICAL: the
// second dimension, of the first one's means.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec2 samples[]; };  // depth, normal
layout(std430, set = 0, binding = 1) writeonly buffer After { uint after[]; };      // packed; where neighbor is fluid
layout(std430, set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
#define BLOCKS 3
#include "render/surface_block.glsl"
#include "render/surface_mean_normal.glsl"
#ifdef VERTICAL
layout(std430, set = 0, binding = 4) readonly buffer Before { uint before[]; };     // of the first dimension
const int kVertical = 1;
#else
const int kVertical = 0;
#endif

const float kReach = 2.0;  // spacings

#ifdef VERTICAL
vec3 normalAt(uint index, uvec2 stored) { return unpackMean(before[index]); }
#else
vec3 normalAt(uint index, uvec2 stored) { return unpackNormal(stored.y); }
#endif

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const uvec2 own = samples[index];
  if (own.x == kNoDepthBits) return;
  const float z = uintBitsToFloat(own.x), spacing = spacingAt(z);
  if (z <= nearestDrawn()) {  // the section with the near plane is not a surface
    after[index] = packMean(unpackNormal(own.y));
    return;
  }
  const Taps taps = tapsOver(kReach, z);
  const ivec2 along = ivec2(1 - kVertical, kVertical) * taps.stride;
  const vec3 sight = normalize(rayAlong(axisOf(samplePixel(p))));
  const vec3 normal = unpackNormal(own.y);
  vec3 sum = normalAt(index, own);
  float weights = 1.0;
  RILL_LOOP for (int k = 1; k <= kTaps; ++k) {
    const float inside = tapWeight(taps, k), across = float(k) * taps.apart * kReach * spacing;
    RILL_LOOP for (int s = -1; s <= 1; s += 2) {
      const ivec2 neighbor = p + s * k * along;
      if (any(lessThan(neighbor, ivec2(0))) || any(greaterThanEqual(neighbor, grid))) continue;
      const uint at = uint(neighbor.y * grid.x + neighbor.x);
      const uvec2 other = samples[at];
      const float w = inside * sameSurface(uintBitsToFloat(other.x) - z, allowedDepthChange(spacing, across, normal, sight));
      weights += inside;
      if (w > 0.0) sum += w * normalAt(at, other);
    }
  }
  after[index] = packMean(sum / weights);
}
