#include "fluid/grid_size.hpp"

#include <algorithm>
#include <cmath>

#include "shared/fluid_records.h"

namespace rill {

uint64_t maxGridCells(uint64_t particles) { return std::max<uint64_t>(4096, 4 * particles); }

GridSize chooseGridSize(double cell, const Double3& extent, uint64_t particles) {
  const GridSize least;
  GridSize size;
  size.cell = cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = axis == 0 ? cell / kCellsPerReach : cell;
    size.size[axis] = static_cast<uint32_t>(std::clamp(std::ceil(extent[axis] / edge) + 1.0, double(least.size[axis]), 4096.0));
  }
  const uint64_t most = maxGridCells(particles);
  while (size.cells() > most) {
    uint32_t* longest = std::max_element(size.size, size.size + 3);
    const uint32_t smallest = least.size[longest - size.size];
    if (*longest <= smallest) break;
    *longest = std::max((*longest + 1) / 2, smallest);
  }
  return size;
}

}  // namespace rill
