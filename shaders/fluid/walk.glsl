// Visits the particles of the 27 cells around `home`, but for i itself: `visitor(j, PARTICLE(j))`. Needs PARTICLE(j), the sorted particles' cell starts and `sums`.
#ifndef RILL_WALK_GLSL
#define RILL_WALK_GLSL
#include "fluid/grid.glsl"

#define WALK_GRID(i, home, visitor)                                                    \
  uint walked = 0u, parts = home.x == 0u || home.x == gridMask().x ? 2u : 1u;          \
  for (uint row = 0u; row < 9u; ++row) {                                               \
    for (uint part = 0u; part < parts; ++part) {                                       \
      uint first, last;                                                                \
      rowKeys(home, row, part, first, last);                                           \
      uint j = cellStart[first], end = first == last ? j : cellStart[last];            \
      end = min(end, j + (kWalkBound - walked));                                       \
      walked += end - j;                                                               \
      for (; j < end; ++j) {                                                           \
        if (j != i) visitor(j, PARTICLE(j));                                           \
      }                                                                                \
    }                                                                                  \
  }                                                                                    \
  if (walked == kWalkBound) atomicAdd(sums.boundHits, 1u);
#endif
