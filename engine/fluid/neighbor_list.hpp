#pragma once
// A snapshot's neighbor lists as the device stores them: see shaders/shared/neighbor_list.h.
#include <cstdint>
#include <span>
#include <vector>

#include "rill/snapshot.hpp"

namespace rill {

/// Entries that a particle's neighbors take on the device: more than there are neighbors where some are far apart, or images.
uint32_t listEntries(uint32_t particle, std::span<const uint32_t> neighbors);

/// The list heads of all particles.
std::vector<uint32_t> layOutHeads(const FluidSnapshot& snapshot);

/// The list of particles [first, last): k-major in blocks of kListBlock particles, four entries in two words. `out` (words) has room for
/// whole blocks and is written where it will be read.
void layOutList(const FluidSnapshot& snapshot, uint32_t first, uint32_t last, std::span<uint32_t> out);

/// The other way: appends the neighbors of particles [first, last) and their counts to the snapshot. Of a particle that exceeds the list's
/// capacity the count is more than that, and there are no neighbors.
void gatherList(FluidSnapshot& snapshot, uint32_t first, uint32_t last, std::span<const uint32_t> heads, std::span<const uint32_t> list);

}  // namespace rill
