// The final slot of an index in a counting sort: the number of smaller indices in its bin. This makes the
// sort stable and independent of the order of the atomics. For bins up to kBinLimit; sort/order_oversized
// handles larger ones. The including shader declares startAt() and arrivedAt() before.
#ifndef RILL_PLACE_GLSL
#define RILL_PLACE_GLSL
#include "sort/sort_types.h"

uint placeOf(uint index, uint begin, uint end) {
  uint place = begin;
  for (uint other = begin; other < end; ++other) place += arrivedAt(other) < index ? 1u : 0u;
  return place;
}
#endif
