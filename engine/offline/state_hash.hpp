#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "rill/fluid.hpp"
#include "rill/vectors.hpp"

namespace rill::offline {

/// Indices that sort `ids` in increasing order. Takes linear time if the ids are a permutation of 0 .. n-1, as in a simulation.
std::vector<uint32_t> orderById(std::span<const uint32_t> ids);

/// 64-bit FNV-1a over the bits of position and velocity of each particle in id order, to compare states. `positions`: m, relative to the
/// scene's origin, as on the device. Then over those of the motion of each body. Then over the indices of the particles' fluids
/// (`fluids`; empty: all 0), unless all are 0, and over the bits of the concentrations in each particle.
uint64_t stateHash(std::span<const Float3> positions, std::span<const Float3> velocities, std::span<const uint32_t> ids,
                   std::span<const BodyMotion> bodies = {}, std::span<const uint8_t> fluids = {},
                   std::span<const Float4> concentrations = {});

}  // namespace rill::offline
