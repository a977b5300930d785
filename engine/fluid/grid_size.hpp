#pragma once
#include <cstdint>

#include "rill/vectors.hpp"

namespace rill {

/// The wrapped grid: cell coordinates are taken modulo its size a dimension, so that particles may be anywhere.
struct GridSize {
  double cell = 0;               ///< m, in y and z; kCellsPerReach times shorter in x
  uint32_t size[3] = {8, 4, 4};  ///< at least these: the cells around a coordinate differ

  uint64_t cells() const { return uint64_t{size[0]} * size[1] * size[2]; }
};

/// What a grid of so many particles has at most.
uint64_t maxGridCells(uint64_t particles);

/// Dimensions that cover `extent` (m) where that takes at most about four cells a particle, else wrapped, the longest dimension halved
/// first. Clearing and scanning cost a cell what a sort costs a particle, so more cells than that buy nothing.
GridSize chooseGridSize(double cell, const Double3& extent, uint64_t particles);

}  // namespace rill
