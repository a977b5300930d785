// How much of the pixel around a ray is fluid near a depth, from the centers alone. Needs surface_arrays.glsl.
#include "render/surface_walk.glsl"
#include "render/surface_edge.glsl"

const float kCoverDepth = 1.6;  // spacings before and behind the depth

float coverOf(vec2 axis, float depth) {
  const vec3 x = rayFrom(axis) + depth * rayAlong(axis);
  const float spacing = spacingAt(depth), reach = kCoverReach * spacing, inverse = 1.0 / (reach * reach);
  const CellRange range = cellsAround(x, reach);
  float cover = 0.0;
  for (int y = range.first.y; y <= range.last.y; ++y) {
    const uvec2 row = rowOf(range, y);
    for (uint j = row.x; j < row.y; ++j) {
      const vec3 at = centerAt(j).xyz;
      if (abs(at.z - depth) > kCoverDepth * spacing) continue;
      cover += coverOfCenter(at, axis, inverse);
    }
  }
  return coverageAt(cover - kCoverBare, depth);
}
