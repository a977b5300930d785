#version 460
// One step of screen-space curvature flow (van der Laan, Green and Sainz 2009). The surface is continued across depth edges, so that
// silhouettes stay. Each sample takes the steps that its width needs: wide, distant samples take few.
#extension GL_GOOGLE_include_directive : require
#define RILL_PUSH_MORE uint iteration;  // number of this step
#include "render/surface.glsl"
#include "shared/arrays.glsl"
#include "render/surface_filter.glsl"

READ_FLOAT(0, before)
layout(std430, set = 0, binding = 1) writeonly buffer After { float after[]; };
layout(std430, set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
#define BLOCKS 3
#define LEVELS
#include "render/surface_block.glsl"
#include "render/surface_pyramid.glsl"

layout(constant_id = 0) const float kStep = kFlowStable;  // squared samples; the stability test uses others

float at(ivec2 p, ivec2 grid) { return beforeAt(uint(clamp(p.y, 0, grid.y - 1) * grid.x + clamp(p.x, 0, grid.x - 1))); }

void main() {
  const ivec2 grid = ivec2(sampleGrid());
  ivec2 p;
  if (!ownSample(p)) return;
  const uint index = uint(p.y * grid.x + p.x);
  const float z = beforeAt(index);
  if (z >= noDepth()) return;
  const float length = metersASample(z), steps = max(ceil(view.smoothing / (kStep * length * length)), 1.0);
  if (float(iteration) >= steps) {
    after[index] = z;
    return;
  }
  const float q = toLinear(z), edge = edgeAt(z);
  float side[9];
  for (int k = 0; k < 9; ++k) side[k] = at(p + ivec2(k % 3 - 1, k / 3 - 1), grid);
  float value[9];
  // A neighbor on another surface is extrapolated from its opposite, or replaced by this sample.
  for (int k = 0; k < 9; ++k) {
    const bool same = abs(side[k] - z) < edge, other = abs(side[8 - k] - z) < edge;
    value[k] = same ? toLinear(side[k]) : (other ? 2.0 * q - toLinear(side[8 - k]) : q);
  }
  const float scale = depthPerLinear(z) / length;
  const float zx = 0.5 * (value[5] - value[3]) * scale, zy = 0.5 * (value[7] - value[1]) * scale;
  const float zxx = (value[5] - 2.0 * q + value[3]) * scale / length, zyy = (value[7] - 2.0 * q + value[1]) * scale / length;
  const float zxy = 0.25 * (value[8] - value[6] - value[2] + value[0]) * scale / length;
  const float square = 1.0 + zx * zx + zy * zy;
  const float twice = ((1.0 + zy * zy) * zxx - 2.0 * zx * zy * zxy + (1.0 + zx * zx) * zyy) / square;
  const float moved = clamp(0.5 * view.smoothing / steps * twice, -0.25 * view.spacing, 0.25 * view.spacing);
  after[index] = z + moved;
}
