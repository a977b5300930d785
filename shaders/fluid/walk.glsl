// Visits the particles of the cells around `home` but for i itself: visitor(j, PARTICLE(j)). CELLS may narrow `low` and `high`, the cells of a `row`.
// Needs PARTICLE(j), the starts of the cells that the particles were sorted by, and `sums`.
#ifndef RILL_WALK_GLSL
#define RILL_WALK_GLSL
#include "fluid/grid.glsl"

#define WALK_GRID(i, home, CELLS, visitor)                                                               \
  uint walked = 0u, parts = home.x < kCellsPerReach || home.x + kCellsPerReach > gridMask.x ? 2u : 1u;   \
  for (uint row = 0u; row < 9u; ++row) {                                                                 \
    int low = -int(kCellsPerReach), high = int(kCellsPerReach);                                          \
    CELLS                                                                                                \
    for (uint part = 0u; part < parts; ++part) {                                                         \
      uint first, last;                                                                                  \
      rowKeys(home, row, low, high, part, first, last);                                                  \
      uint j = cellStart[first], end = first == last ? j : cellStart[last];                              \
      end = min(end, j + (kWalkBound - walked));                                                         \
      walked += end - j;                                                                                 \
      for (; j < end; ++j) {                                                                             \
        if (j != i) visitor(j, PARTICLE(j));                                                             \
      }                                                                                                  \
    }                                                                                                    \
  }                                                                                                      \
  if (walked == kWalkBound) atomicAdd(sums.boundHits, 1u);
#endif
