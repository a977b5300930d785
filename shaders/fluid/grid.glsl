// The wrapped grid: cell coordinates modulo a power of two a dimension, so that the domain is unbounded. Needs `params`.
#ifndef RILL_GRID_GLSL
#define RILL_GRID_GLSL
uvec3 gridMask() {
  return (uvec3(1u) << uvec3(params.gridBitsX, params.gridBitsY, params.gridBitsZ)) - 1u;
}

uint cellKey(uvec3 cell) {
  return ((cell.z << params.gridBitsY | cell.y) << params.gridBitsX) | cell.x;
}

uvec3 cellOf(vec3 x) {
  vec3 scaled = clamp(floor(x * params.inverseCell), -1.0e9, 1.0e9);
  return uvec3(ivec3(scaled)) & gridMask();
}

uvec3 cellFromKey(uint key) {
  uvec3 mask = gridMask();
  return uvec3(key & mask.x, key >> params.gridBitsX & mask.y, key >> (params.gridBitsX + params.gridBitsY));
}

// Row `row` of 0 .. 8 around a cell: three cells that follow each other in x are one range of keys, two where the row wraps (part 0 and 1).
// Gives the keys [first, last) of the part; first == last where there is none.
void rowKeys(uvec3 cell, uint row, uint part, out uint first, out uint last) {
  uvec3 mask = gridMask();
  uint y = (cell.y + row % 3u - 1u) & mask.y;
  uint z = (cell.z + row / 3u - 1u) & mask.z;
  uint base = cellKey(uvec3(0u, y, z));
  uint low = cell.x == 0u ? 0u : cell.x - 1u;
  uint high = min(cell.x + 1u, mask.x);
  bool wraps = high - low < 2u;
  uint other = cell.x == 0u ? mask.x : 0u;
  first = base + (part == 0u ? low : other);
  last = base + (part == 0u ? high + 1u : (wraps ? other + 1u : other));
}
#endif
