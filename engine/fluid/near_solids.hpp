#pragma once
// Which solids are near which particles, as the device stores it (shaders/shared/solid_records.h).
#include <cstdint>
#include <span>
#include <vector>

#include "rill/snapshot.hpp"

namespace rill {

/// Four words each, of an entry: what all solids of a scene take, at most kMaxNearQuads.
uint32_t nearSolidQuads(uint64_t solids);

/// How many entries a fluid that continues from a snapshot begins with, and these as the device stores them. Before the first list of
/// neighbors any solid may be near any particle.
size_t nearSolidCount(const FluidSnapshot& snapshot);
std::vector<uint32_t> layOutNearSolids(const FluidSnapshot& snapshot, uint32_t quads);
/// The other way. `words`: whole entries.
std::vector<NearSolids> gatherNearSolids(std::span<const uint32_t> words, uint32_t quads);

/// Whether the solids of an entry exist, increase, and end.
bool listsSolids(const NearSolids& near, uint32_t solidCount);

}  // namespace rill
