#version 460
// A bilateral filter of depth (Tomasi and Manduchi 1998): a spatial Gaussian times a Gaussian over depth differences, in 1D or 2D.
#extension GL_GOOGLE_include_directive : require
#define RILL_PUSH_MORE float range;  // spacings: standard deviation of the Gaussian over depth
#include "render/surface.glsl"
#include "render/surface_filter.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Before { float before[]; };
layout(std430, set = 0, binding = 1) writeonly buffer After { float after[]; };
layout(constant_id = 0) const int kColumns = 1;  // 1: filters along x
layout(constant_id = 1) const int kRows = 1;     // 1: filters along y

const float kReach = 2.3;  // standard deviations
const int kMaxReach = 64;  // samples

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  const int groups = (grid.x + 7) / 8;
  const ivec2 p = ivec2(int(groupIndex()) % groups, int(groupIndex()) / groups) * 8 + ivec2(gl_LocalInvocationID.xy);
  if (p.x >= grid.x || p.y >= grid.y) return;
  const uint index = uint(p.y * grid.x + p.x);
  const float z = before[index];
  if (z >= noDepth()) {
    after[index] = z;
    return;
  }
  const float length = metersASample(z) / view.spacing;
  const int reach = clamp(int(kReach * view.smoothing / length), 1, kMaxReach);
  const ivec2 far = reach * ivec2(kColumns, kRows);
  float sum = 0.0, weights = 0.0;
  for (int y = max(p.y - far.y, 0); y <= min(p.y + far.y, grid.y - 1); ++y)
    for (int x = max(p.x - far.x, 0); x <= min(p.x + far.x, grid.x - 1); ++x) {
      const float other = before[uint(y * grid.x + x)];
      if (other >= noDepth()) continue;
      const vec2 across = vec2(ivec2(x, y) - p) * length / view.smoothing;
      const float along = (other - z) / (range * view.spacing);
      const float w = exp(-0.5 * (dot(across, across) + along * along));
      sum += w * toLinear(other);
      weights += w;
    }
  after[index] = toDepth(sum / weights);
}
