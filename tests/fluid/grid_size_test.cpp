// The grid's size: what it covers, and where it wraps instead.
#include "fluid/grid_size.hpp"

#include <gtest/gtest.h>

#include "shared/fluid_records.h"

namespace rill {
namespace grid_size_test {

constexpr double kCell = 0.125;

GridSize sized(double x, double y, double z, uint64_t particles) {
  const Double3 extent = {x, y, z};
  return chooseGridSize(kCell, extent, particles);
}

TEST(GridSizeTest, CoversTheDomainWithoutOverlappingItself) {
  for (double room : {1.0, 1.01, 4.9, 5.0, 12.3}) {
    const GridSize grid = sized(room, room, room, 10'000'000);
    for (int axis = 0; axis < 3; ++axis) {
      const double edge = axis == 0 ? kCell / kCellsPerReach : kCell;
      EXPECT_GE(grid.size[axis] * edge, room) << axis;
      EXPECT_LT((grid.size[axis] - 2) * edge, room) << axis;
    }
    EXPECT_EQ(grid.cells(), uint64_t{grid.size[0]} * grid.size[1] * grid.size[2]);
  }
}

TEST(GridSizeTest, KeepsNeighboringCellsDistinct) {
  const GridSize grid = sized(0, 0, 1e-6, 1);
  EXPECT_GE(grid.size[0], 2 * kCellsPerReach + 3);
  EXPECT_GE(grid.size[1], 3u);
  EXPECT_GE(grid.size[2], 3u);
}

TEST(GridSizeTest, WrapsDomainsWithMoreCellsThanNeeded) {
  for (uint64_t particles : {uint64_t{1}, uint64_t{5000}, uint64_t{4} << 20}) {
    for (double x : {1.0, 300.0, 1e30}) {
      const GridSize grid = sized(x, 300, 1e12, particles);
      EXPECT_LE(grid.cells(), maxGridCells(particles)) << x;
      EXPECT_GE(grid.cells(), maxGridCells(particles) / 8) << x << ": as many as it may have";
    }
  }
}

}  // namespace grid_size_test
}  // namespace rill
