// Lists a particle and the solids near it, as fluid/near_solids.glsl reads them. Needs `params`, `sums`, nearSolids,
// solidAt() and cull_solids.glsl.
#ifndef RILL_LIST_SOLIDS_GLSL
#define RILL_LIST_SOLIDS_GLSL
// Puts a solid at a place, in halves of words.
void putSolid(inout uvec4 quad, uint place, uint k) {
  uvec4 put = place % 2u == 0u ? (quad & 0xffff0000u) | k : (quad & 0xffffu) | k << 16;
  quad = mix(quad, put, equal(uvec4(0u, 1u, 2u, 3u), uvec4(place / 2u % 4u)));
}

// Lists the particle and the solids near it; whether there are any.
bool listNear(uint i, vec3 x) {
  if (!isActive(x)) return false;
  const uint kListed = 8u * NEAR_QUADS - 2u, kNothing = kNoSolid | kNoSolid << 16;
  uint found = 0u, first = 0u;
  uvec4 quad = uvec4(i, uvec3(kNothing));
  for (uint word = 0u; 32u * word < params.solidCount; ++word) {
    uint mask = solidsMayBeNear(word);
    LOOP_WHILE (mask != 0u) {
      uint k = 32u * word + findLSB(mask);
      SolidRecord s = solidAt(k);
      vec3 normal;
      if (surfaceDistance(s.shape, localPoint(s.pose, x), normal) < params.nearLimit) {
        if (found == 0u) first = NEAR_QUADS * atomicAdd(sums.nearSolids, 1u);
        if (found < kListed) {
          uint place = found + 2u;  // the particle takes two
          if (place % 8u == 0u) {
            nearSolids[first + place / 8u - 1u] = quad;
            quad = uvec4(kNothing);
          }
          putSolid(quad, place, k);
        }
        ++found;
      }
      mask &= mask - 1u;
    } LOOP_END(mask != 0u);
  }
  if (found == 0u) return false;
  uint last = (min(found, kListed) + 1u) / 8u;
  nearSolids[first + last] = quad;
  for (uint q = last + 1u; q < NEAR_QUADS; ++q) nearSolids[first + q] = uvec4(kNothing);
  if (found > kListed) nearSolids[first].y = kAllSolids | kNoSolid << 16;
  return true;
}
#endif
