// The solids near a particle, as build.comp lists them (NearSolidRecord without its particle):
//   for (uint n = 0u, k; nextSolid(listed, n, k); ++n) { ... solids[k] ... }
#ifndef RILL_NEAR_SOLIDS_GLSL
#define RILL_NEAR_SOLIDS_GLSL
#include "shared/solid_records.h"

const uvec3 kNothingNear = uvec3(kNoSolid | kNoSolid << 16);

void addSolid(inout uvec3 listed, uint n, uint k) {
  uvec3 pair = n % 2u == 0u ? (listed & 0xffff0000u) | k : (listed & 0xffffu) | k << 16;
  listed = mix(listed, pair, equal(uvec3(0u, 1u, 2u), uvec3(n / 2u)));
}

bool nextSolid(uvec3 listed, uint n, out uint k) {
  bool all = (listed.x & 0xffffu) == kAllSolids;
  uint pair = n < 2u ? listed.x : (n < 4u ? listed.y : listed.z);
  k = all ? n : (n % 2u == 0u ? pair & 0xffffu : pair >> 16);
  return all ? n < params.solidCount : n < kListedSolids && k != kNoSolid;
}
#endif
