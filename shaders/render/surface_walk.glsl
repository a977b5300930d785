// The cells of the screen grid around a point. Needs `start`.
struct CellRange {
  ivec2 first, last;  // both included
};

CellRange cellsAround(vec3 point, float reach) {
  const float side = reach / metresAPixel(max(point.z - reach, 0.5 * point.z));
  const vec2 middle = pixelOf(point);
  CellRange range = CellRange(cellOf(clamp(middle - side, vec2(-1e6), vec2(1e6))), cellOf(clamp(middle + side, vec2(-1e6), vec2(1e6))));
  const ivec2 centre = (range.first + range.last) / 2;
  range.first.y = max(range.first.y, centre.y - int(kMostRows) / 2);
  range.last.y = min(range.last.y, range.first.y + int(kMostRows) - 1);
  return range;
}
// Surface particles of one row of the range: first, and the one after the last.
uvec2 rowOf(CellRange range, int y) {
  const uint row = uint(y) * cellGrid().x;
  const uint begin = start[row + uint(range.first.x)];
  return uvec2(begin, min(start[row + uint(range.last.x) + 1u], begin + kMostInRow));
}
