// A separation direction for two coincident particles, computed from their ids. Shared by C++ and GLSL:
// integer arithmetic only, so both give identical results.
#ifndef RILL_SHADERS_SHARED_PAIR_HASH_H
#define RILL_SHADERS_SHARED_PAIR_HASH_H

#ifdef __cplusplus
#include <cstdint>
#define RILL_PAIR_UINT std::uint32_t
#define RILL_PAIR_INT std::int32_t
#define RILL_PAIR_FUNCTION inline
namespace rill::shared {
#else
#define RILL_PAIR_UINT uint
#define RILL_PAIR_INT int
#define RILL_PAIR_FUNCTION
#endif

/// A permutation of 32 bits: the finalizer of MurmurHash3 (Appleby).
RILL_PAIR_FUNCTION RILL_PAIR_UINT pairMix(RILL_PAIR_UINT x) {
  x ^= x >> 16u;
  x *= 0x85ebca6bu;
  x ^= x >> 13u;
  x *= 0xc2b2ae35u;
  x ^= x >> 16u;
  return x;
}

/// Symmetric hash of two ids. Bits 0-9, 10-19 and 20-29 are the components of the direction.
RILL_PAIR_FUNCTION RILL_PAIR_UINT pairHash(RILL_PAIR_UINT idI, RILL_PAIR_UINT idJ) {
  RILL_PAIR_UINT lower = idI < idJ ? idI : idJ;
  RILL_PAIR_UINT upper = idI < idJ ? idJ : idI;
  return pairMix(lower ^ pairMix(upper + 0x9e3779b9u));
}

/// Component `axis` (0, 1, 2) of the direction from j to i, not normalized: odd (never zero), in -1023 .. 1023.
/// Antisymmetric: exchanging i and j changes the sign.
RILL_PAIR_FUNCTION RILL_PAIR_INT pairDirection(RILL_PAIR_UINT idI, RILL_PAIR_UINT idJ, RILL_PAIR_UINT axis) {
  RILL_PAIR_INT component = 2 * RILL_PAIR_INT((pairHash(idI, idJ) >> (10u * axis)) & 1023u) - 1023;
  return idI < idJ ? component : -component;
}

#ifdef __cplusplus
}  // namespace rill::shared
#endif

#undef RILL_PAIR_UINT
#undef RILL_PAIR_INT
#undef RILL_PAIR_FUNCTION
#endif
