// Bindings 2 to 5 of the passes that move particles into the order of their cells: what the sort
// gave. A slot of the sorted arrays is taken for one particle, which belongs into another slot of
// the same cell.
#ifndef RILL_SORTED_PLACES_GLSL
#define RILL_SORTED_PLACES_GLSL
#include "shared/arrays.glsl"
READ_UINT(2, key)
READ_UINT(3, start)
READ_UINT(4, arrived)
READ_UINT(5, order)  // of cells with more than kBinLimit particles
#include "sort/place.glsl"

// The particle that the invocation `slot` moves, by its place before the sort; and its new place.
uint arrival(uint slot, out uint place) {
  uint from = arrivedAt(slot), key = keyAt(from);
  uint begin = startAt(key), end = startAt(key + 1u);
  place = slot;
  if (end - begin > kBinLimit) return orderAt(slot);
  place = placeOf(from, begin, end);
  return from;
}
#endif
