// The solids near a particle, as build.comp lists them. Needs `params` and nearSolidsAt(), the array of their entries:
//   NearSolids near = nearSolidsOf(n);  // entry n; near.particle
//   for (uint m = 0u, k; nextSolid(near, m, k); ++m) { ... solidAt(k) ... }
#ifndef RILL_NEAR_SOLIDS_GLSL
#define RILL_NEAR_SOLIDS_GLSL
#include "shared/solid_records.h"

struct NearSolids {
  uint particle;
  uint first;   // its place in nearSolidsAt()
  uvec4 begin;  // what is there
  bool all;     // any solid may be near
  uint mask;    // which of those that are listed are visited
};

NearSolids nearSolidsOf(uint n) {
  uvec4 begin = nearSolidsAt(NEAR_QUADS * n);
  return NearSolids(begin.x, NEAR_QUADS * n, begin, (begin.y & 0xffffu) == kAllSolids, 0xffffffffu);
}

bool nextSolid(NearSolids near, inout uint m, out uint k) {
  uint left = m < 32u ? near.mask >> m : 0u;
  if (!near.all) m = left == 0u ? kListedSolids : m + findLSB(left);
  uint place = m + 2u;  // in halves of words: the particle takes two
  uvec4 quad = near.begin;
  if (NEAR_QUADS > 1u && place >= 8u && place < 8u * NEAR_QUADS && !near.all) quad = nearSolidsAt(near.first + place / 8u);
  uint word = quad[place / 2u % 4u];
  k = near.all ? m : (place % 2u == 0u ? word & 0xffffu : word >> 16);
  return near.all ? m < params.solidCount : place < 8u * NEAR_QUADS && k != kNoSolid;
}
#endif
