// The rows of grid cells around a place. Before it includes this the shader makes cellStartAt(), the starts of the cells that the
// particles were sorted by.
#ifndef RILL_CELL_ROWS_GLSL
#define RILL_CELL_ROWS_GLSL
#include "fluid/grid.glsl"

// Row `side` of 0 .. 8 around the row (y, z) of cells: the particles [begin, end) in it that can be
// within `reach` (m) of a box in that row, which goes from low to high (in cells) in x and keeps
// `gaps` (m) from the row's sides at low y, low z, high y, high z. The row is two ranges where it
// wraps: part 0 and 1.
void rowRange(float low, float high, vec2 row, vec4 gaps, float reach, uint side, uint part, out uint begin, out uint end) {
  vec2 offset = vec2(side % 3u, side / 3u) - 1.0;
  vec2 gap = vec2(offset.x < 0.0 ? gaps.x : (offset.x > 0.0 ? gaps.z : 0.0), offset.y < 0.0 ? gaps.y : (offset.y > 0.0 ? gaps.w : 0.0));
  float left = reach * reach - dot(gap, gap);
  begin = 0u;
  end = 0u;
  if (left < 0.0) return;
  float width = sqrt(left) * inverseCell.x;
  vec2 cells = floor(vec2(low, high));
  float from = cells.x + floor(low - cells.x - width), to = cells.y + floor(high - cells.y + width);
  vec3 cell = wrapped(vec3(from, row + offset));
  float past = cell.x + (to - from) + 1.0;
  if (to - from >= gridSize.x - 1.0) {  // all around
    cell.x = 0.0;
    past = gridSize.x;
  }
  if (part == 1u && past <= gridSize.x) return;
  uint base = cellKey(vec3(0.0, cell.yz)), size = uint(gridSize.x);
  begin = cellStartAt(base + (part == 0u ? min(uint(cell.x), size) : 0u));  // at most: of NaN, too
  end = cellStartAt(base + min(uint(part == 0u ? past : past - gridSize.x), size));
}
#endif
