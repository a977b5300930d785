#version 460
// The narrow-range filter (Truong and Yuksel 2018), one dimension of it: a Gaussian that ignores samples far in front and clamps those
// far behind.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "shared/arrays.glsl"
#include "render/surface_filter.glsl"

READ_FLOAT(0, before)
layout(std430, set = 0, binding = 1) writeonly buffer After { float after[]; };
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
#define BLOCKS 3
#include "render/surface_block.glsl"
layout(constant_id = 0) const bool VERTICAL = false;

const float kReach = 2.3076923;  // standard deviations: the Gaussian is cut at 0.07 of its peak
const float kFront = 2.0;        // spacings in front of this sample: another surface
const float kBehind = 1.0;       // spacings behind it at most
const uint kMaxTaps = 3u;       // margins of samples

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const float z = beforeAt(index);
  if (z >= noDepth()) return;
  const float length = metersASample(z) / view.spacing;
  const int wanted = max(int(min(kReach * view.smoothing / length, 1e6)), 1), taps = min(wanted, int(kMaxTaps * view.margin));
  if (taps < wanted) atomicAdd(counters[kBoundHits], 1u);
  // Not a choice between constant vectors, which lavapipe (Mesa 22.3) folds to (0, 0) with a specialization constant.
  const ivec2 along = ivec2(1 - int(VERTICAL), int(VERTICAL));
  float sum = toLinear(z), weights = 1.0;
  for (int k = 1; k <= taps; ++k) {
    // Both sides or none, because a missing side would tilt the surface.
    float pair = 0.0;
    bool whole = true;
    for (int s = -1; s <= 1; s += 2) {
      const ivec2 neighbor = p + s * k * along;
      const bool inside = all(greaterThanEqual(neighbor, ivec2(0))) && all(lessThan(neighbor, grid));
      const float other = inside ? beforeAt(uint(neighbor.y * grid.x + neighbor.x)) : noDepth();
      whole = whole && other > z - kFront * view.spacing * float(k) * length && other < noDepth();
      const float slope = float(k) * length;  // allows for a slanted surface
      pair += toLinear(min(other, z + (kBehind + 2.0 * slope) * view.spacing));
    }
    const float off = float(k) * length / view.smoothing;
    const float w = whole ? exp(-0.5 * off * off) : 0.0;
    sum += w * pair;
    weights += 2.0 * w;
  }
  after[index] = toDepth(sum / weights);
}
