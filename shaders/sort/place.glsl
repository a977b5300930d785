// The places of a counting sort's indices, which have arrived in their bins in any order: an
// index's place is the number of smaller ones in its bin. That makes the sort stable, and its
// result independent of the order of atomics. For bins of up to kBinLimit; larger ones are put in
// order by sort/order_oversized. The shader makes startAt() and arrivedAt() before it includes
// this.
#ifndef RILL_PLACE_GLSL
#define RILL_PLACE_GLSL
#include "sort/sort_types.h"

uint placeOf(uint index, uint begin, uint end) {
  uint place = begin;
  for (uint other = begin; other < end; ++other) place += arrivedAt(other) < index ? 1u : 0u;
  return place;
}
#endif
