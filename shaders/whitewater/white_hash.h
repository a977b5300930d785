// Random numbers of whitewater, by counters. Integer arithmetic shared by C++ and GLSL.
#ifndef RILL_WHITE_HASH_H
#define RILL_WHITE_HASH_H
#include "shared/pair_hash.h"
#ifdef __cplusplus
#define RILL_WHITE_FUNCTION inline
namespace rill {
using shared::pairMix;
using uint = uint32_t;
#else
#define RILL_WHITE_FUNCTION
#endif

/// Of a fluid particle's slot, a step and a birth.
RILL_WHITE_FUNCTION uint whiteHash(uint seed, uint slot, uint step, uint birth) {
  return pairMix(birth + 0x9e3779b9u + pairMix(step + 0x7f4a7c15u + pairMix(slot + pairMix(seed + 0x85ebca6bu))));
}
/// Number k of a hash.
RILL_WHITE_FUNCTION uint whiteNumber(uint hash, uint k) { return pairMix(hash + 0x9e3779b9u * (k + 1u)); }

/// Bin of a cell of the grid. Cells along z lie side by side; behind the last bin comes the first.
RILL_WHITE_FUNCTION uint whiteBin(uint x, uint y, uint z, uint bins) { return (pairMix(x * 73856093u ^ y * 19349663u) + z) & (bins - 1u); }

#ifdef __cplusplus
}  // namespace rill
#endif
#undef RILL_WHITE_FUNCTION
#endif
