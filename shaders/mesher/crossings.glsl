// Bit a: the surface crosses the edge of a cell along axis a from its lowest corner.
uint crossings(uint inside) {
  const uint lowest = (inside & 1u) * 7u;
  return ((inside >> 1u & 1u) | (inside >> 2u & 1u) << 1u | (inside >> 4u & 1u) << 2u) ^ lowest;
}
