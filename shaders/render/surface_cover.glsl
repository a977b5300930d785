// How much of the pixel around a ray is fluid near a depth, from the centres alone. Needs surface_arrays.glsl.
#include "render/surface_walk.glsl"
#include "render/surface_edge.glsl"

const float kCoverDepth = 1.6;  // spacings before and behind the depth

float coverOf(vec2 axis, float depth) {
  const vec3 x = rayFrom(axis) + depth * rayAlong(axis);
  const float spacing = spacingAt(depth), reach = kCoverReach * spacing, inverse = 1.0 / (reach * reach);
  const CellRange range = cellsAround(x, reach);
  float cover = 0.0;
  int y = range.first.y;
  LOOP_WHILE (y <= range.last.y) {
    const uvec2 row = rowOf(range, y);
    uint j = row.x;
    LOOP_WHILE (j < row.y) {
      const vec3 at = centreAt(j).xyz;
      if (abs(at.z - depth) <= kCoverDepth * spacing) cover += coverOfCentre(at, axis, inverse);
      ++j;
    } LOOP_END(j < row.y);
    ++y;
  } LOOP_END(y <= range.last.y);
  return coverageAt(cover - kCoverBare, depth);
}
