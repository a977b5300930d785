// The wrapped grid: cell coordinates modulo a power of two a dimension, so that the domain is unbounded. Cells are kCellsPerReach times narrower in x than in
// y and z: what follows in x is contiguous in the sorted arrays, and narrow cells make its ends fit. Needs `params`.
#ifndef RILL_GRID_GLSL
#define RILL_GRID_GLSL
// Loaded once, see kernel.glsl.
uvec3 gridBits = uvec3(params.gridBitsX, params.gridBitsY, params.gridBitsZ);
uvec3 gridMask = (uvec3(1u) << gridBits) - 1u;
vec3 inverseCell = params.inverseCell * vec3(kCellsPerReach, 1, 1);

uint cellKey(uvec3 cell) { return ((cell.z << gridBits.y | cell.y) << gridBits.x) | cell.x; }

vec3 scaledPosition(vec3 x) { return clamp(x * inverseCell, -1.0e9, 1.0e9); }

uvec3 cellOf(vec3 x) { return uvec3(ivec3(floor(scaledPosition(x)))) & gridMask; }

uvec3 cellFromKey(uint key) {
  return uvec3(key & gridMask.x, key >> gridBits.x & gridMask.y, key >> (gridBits.x + gridBits.y));
}

// Row `row` of 0 .. 8 around the cell `home`, its cells home.x + low .. home.x + high: one range of keys, two where the row wraps (part 0 and 1).
// Gives the keys [first, last) of the part; first == last where there is none.
void rowKeys(uvec3 home, uint row, int low, int high, uint part, out uint first, out uint last) {
  uint y = (home.y + row % 3u - 1u) & gridMask.y;
  uint z = (home.z + row / 3u - 1u) & gridMask.z;
  uint base = cellKey(uvec3(0u, y, z));
  uint from = (home.x + uint(low)) & gridMask.x;
  uint past = from + uint(max(high - low + 1, 0));
  first = base + (part == 0u ? from : 0u);
  last = base + (part == 0u ? min(past, gridMask.x + 1u) : max(past, gridMask.x + 1u) - (gridMask.x + 1u));
}

// The cells of a row, relative to x's own, that hold whatever is nearer to x than `reach` (m, at most a cell's edge in y). None: low > high.
void rowReach(vec3 x, float reach, uint row, out int low, out int high) {
  vec3 scaled = scaledPosition(x);
  vec3 within = scaled - floor(scaled);
  uvec2 side = uvec2(row % 3u, row / 3u);
  vec2 gap = vec2(side.x == 0u ? within.y : (side.x == 2u ? 1.0 - within.y : 0.0), side.y == 0u ? within.z : (side.y == 2u ? 1.0 - within.z : 0.0)) / inverseCell.yz;
  float left = reach * reach - dot(gap, gap);
  float width = sqrt(max(left, 0.0)) * inverseCell.x;
  low = left < 0.0 ? 1 : int(floor(within.x - width));
  high = left < 0.0 ? 0 : int(floor(within.x + width));
}
#endif
