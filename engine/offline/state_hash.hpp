#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rill/float3.hpp"

namespace rill::offline {

/// Indices that visit `ids` in rising order. Ids that are 0 .. n-1, each once (a simulation's own), take linear time.
std::vector<uint32_t> orderById(std::span<const uint32_t> ids);

/// 64-bit FNV-1a over the bits of position and velocity of each particle, in id order: equal hashes mean equal states.
/// Positions are those relative to the scene's origin, as the device holds them.
uint64_t stateHash(std::span<const Float3> positions, std::span<const Float3> velocities, std::span<const uint32_t> ids);

}  // namespace rill::offline
