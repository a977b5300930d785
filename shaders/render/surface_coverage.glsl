// Coverage of a pixel by fluid near a depth, from the centers of particles alone. Needs surface_arrays.glsl.
#include "render/surface_cells.glsl"
#include "render/surface_silhouette.glsl"

const float kCoverDepth = 1.6;  // spacings in front of and behind the depth

float coverageFromCenters(vec2 axis, float depth) {
  const vec3 x = rayFrom(axis) + depth * rayAlong(axis);
  const float spacing = spacingAt(depth), reach = kCoverReach * spacing, inverse = 1.0 / (reach * reach);
  const CellRange range = cellsAround(x, reach);
  float cover = 0.0;
  for (int y = range.first.y; y <= range.last.y; ++y) {
    const uvec2 row = rowOf(range, y);
    for (uint j = row.x; j < row.y; ++j) {
      const vec3 at = centerAt(j).xyz;
      if (abs(at.z - depth) > kCoverDepth * spacing) continue;
      cover += centerWeight(at, axis, inverse);
    }
  }
  return coverageAt(cover - kCoverThreshold, depth);
}
