// Iteration over the cells of the screen grid around a point. Needs surface_arrays.glsl.
bool bound_hit = false;  // an iteration was cut short

struct CellRange {
  ivec2 first, last;  // both included
};

CellRange cellsAround(vec3 point, float reach) {
  const float side = reach / metersAPixel(max(point.z - reach, 0.5 * point.z));
  const vec2 middle = pixelOf(point);
  CellRange range = CellRange(cellOf(clamp(middle - side, vec2(-1e6), vec2(1e6))), cellOf(clamp(middle + side, vec2(-1e6), vec2(1e6))));
  const ivec2 center = (range.first + range.last) / 2;
  bound_hit = bound_hit || range.last.y - range.first.y >= int(kMaxRows);
  range.first.y = max(range.first.y, center.y - int(kMaxRows) / 2);
  range.last.y = min(range.last.y, range.first.y + int(kMaxRows) - 1);
  return range;
}
// Surface particles of one row of the range: the first, and one past the last.
uvec2 rowOf(CellRange range, int y) {
  const uint row = uint(y) * cellGrid().x;
  const uint begin = startAt(row + uint(range.first.x)), end = startAt(row + uint(range.last.x) + 1u);
  bound_hit = bound_hit || end > begin + kMaxInRow;
  return uvec2(begin, min(end, begin + kMaxInRow));
}
