// The places of a counting sort's indices, which have arrived in their bins in any order: an index's place is the number of smaller ones in its bin. That
// makes the sort stable, and its result independent of the order of atomics. For bins of up to kBinLimit; larger ones are put in order by sort/order_oversized.
// The shader makes startAt() and arrivedAt() before it includes this.
#ifndef RILL_PLACE_GLSL
#define RILL_PLACE_GLSL
#include "sort/sort_types.h"
#include "shared/loops.glsl"

uint placeOf(uint index, uint begin, uint end) {
  uint place = begin;
  uint other = begin;
  LOOP_WHILE (other < end) {
    place += arrivedAt(other) < index ? 1u : 0u;
    ++other;
  } LOOP_END(other < end);
  return place;
}
#endif
