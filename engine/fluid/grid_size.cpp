#include "fluid/grid_size.hpp"

#include <algorithm>
#include <cmath>

namespace rill {

GridSize chooseGridSize(double cell, const double extent[3], uint64_t particles) {
  GridSize size;
  size.cell = cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::clamp(std::ceil(extent[axis] / cell) + 1.0, 4.0, 4096.0);
    size.bits[axis] = static_cast<uint32_t>(std::ceil(std::log2(cells)));
  }
  const uint64_t most = std::max<uint64_t>(4096, 2 * particles);
  while (size.cells() > most) {
    uint32_t* longest = std::max_element(size.bits, size.bits + 3);
    if (*longest == 2) break;
    --*longest;
  }
  return size;
}

}  // namespace rill
