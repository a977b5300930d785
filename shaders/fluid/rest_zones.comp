#version 460
// What substeps do with each region, by how near to one awake it is. Its sums are cleared for the next time.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/regions.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer RegionBlock { RegionRecord regions[]; };

bool isAwake(uint r) { return regions[r].state == kRegionAwake || regions[r].woken != 0u; }

uint zoneAround(uint r) {
  if (isAwake(r)) return kZoneMoves;
  uvec3 at = regionAt(r);
  uint zone = kZoneAsleep;
  for (int n = 0; n < 125 && zone > kZoneWatched; ++n) {
    ivec3 offset = ivec3(n % 5, n / 5 % 5, n / 25) - 2;
    bool beside = all(lessThanEqual(abs(offset), ivec3(1)));
    if ((beside || zone == kZoneAsleep) && isAwake(regionBeside(at, offset))) zone = beside ? kZoneWatched : kZoneStill;
  }
  return zone;
}

void main() {
  uint r = flatInvocation();
  if (r >= regionCount()) return;
  regions[r].zone = zoneAround(r);
  regions[r].particles = regions[r].motion = regions[r].fastest = regions[r].nearSolid = 0u;
  regions[r].driftX = regions[r].driftY = regions[r].driftZ = 0;
  regions[r].forceX = regions[r].forceY = regions[r].forceZ = 0;
}
