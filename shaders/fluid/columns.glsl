// How high the fluid stands along the axes of gravity: sums and extremes of the places of active
// particles inside the domain, as integers, so that their order does not matter. Needs `params` and `sums`.
#ifndef RILL_COLUMNS_GLSL
#define RILL_COLUMNS_GLSL
#include "shared/atomic_load.glsl"
// One reduction: with four the list build took a tenth longer on lavapipe. Extremes are rarely exceeded.
#define ADD_TO_COLUMN(AXIS, PLACE)                                                                 \
  if (params.columnGravity##AXIS != 0.0) {                                                         \
    uint place = min(uint(PLACE), kMaxColumnPlace);                                                \
    if (counts && place < ATOMIC_LOAD(sums.columnLow##AXIS)) atomicMin(sums.columnLow##AXIS, place);   \
    if (counts && place > ATOMIC_LOAD(sums.columnHigh##AXIS)) atomicMax(sums.columnHigh##AXIS, place); \
    uint both = subgroupAdd(counts ? kColumnOne | place : 0u), add = both % kColumnOne;            \
    if (subgroupElect()) {                                                                         \
      atomicAdd(sums.columnCount##AXIS, both / kColumnOne);                                        \
      uint old = atomicAdd(sums.columnSumLow##AXIS, add);                                          \
      if (old + add < old) atomicAdd(sums.columnSumHigh##AXIS, 1u);                                \
    }                                                                                              \
  }

const uint kColumnOne = 1u << 25;  // of 64 lanes: 7 bits for how many, 24 for the sum of their places

void addToColumns(bool counts, vec3 x) {
  vec3 low = vec3(params.boundLowX, params.boundLowY, params.boundLowZ);
  vec3 high = vec3(params.boundHighX, params.boundHighY, params.boundHighZ);
  counts = counts && drawable(x) && all(greaterThanEqual(x, low)) && all(lessThanEqual(x, high));
  low = max(low, vec3(-0.5 * float(kMaxColumnPlace) / kColumnUnits * params.spacing));  // without a domain
  vec3 places = max((x - low) * (kColumnUnits / params.spacing), vec3(0.0));
  ADD_TO_COLUMN(X, places.x)
  ADD_TO_COLUMN(Y, places.y)
  ADD_TO_COLUMN(Z, places.z)
}
#endif
