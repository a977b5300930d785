#version 460
// Regions asleep beside one whose fluid moves wake.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/regions.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer RegionBlock { RegionRecord regions[]; };

void main() {
  uint r = flatInvocation();
  if (r >= regionCount() || regions[r].state != kRegionAsleep) return;
  uvec3 at = regionAt(r);
  bool woken = false;
  for (int n = 0; n < 27 && !woken; ++n)
    woken = regions[regionBeside(at, ivec3(n % 3, n / 3 % 3, n / 9) - 1)].moves != 0u;
  if (!woken) return;
  regions[r].woken = 1u;
  regions[r].restShare = 0.0;
}
