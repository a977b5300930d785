// Regions of the grid: see shared/region_records.h. The last one along an axis takes the cells that are left. Needs `params`.
#ifndef RILL_REGIONS_GLSL
#define RILL_REGIONS_GLSL
#include "fluid/grid.glsl"
#include "shared/region_records.h"

uvec3 regionCounts() { return uvec3(params.regionsX, params.regionsY, params.regionsZ); }
uint regionCount() { return params.regionsX * params.regionsY * params.regionsZ; }

uint regionIndex(uvec3 at) { return (at.z * params.regionsY + at.y) * params.regionsX + at.x; }
uvec3 regionAt(uint index) {
  uint row = index / max(params.regionsX, 1u);
  return uvec3(index - row * params.regionsX, row % max(params.regionsY, 1u), row / max(params.regionsY, 1u));
}

uvec3 regionOf(vec3 x) {
  uvec3 size = uvec3(kRegionCellsX, kRegionCellsY, kRegionCellsZ);
  return min(min(uvec3(cellOf(x)), uvec3(gridSize) - 1u) / size, max(regionCounts(), 1u) - 1u);
}

// The region `offset` away, of which each component is -2 .. 2, on the wrapped grid.
uint regionBeside(uvec3 at, ivec3 offset) {
  ivec3 counts = ivec3(regionCounts()), beside = ivec3(at) + offset;  // no remainder: CPU drivers compute one at a time
  beside += counts * (ivec3(lessThan(beside, ivec3(0))) - ivec3(greaterThanEqual(beside, counts)));
  return regionIndex(uvec3(beside));
}

// Regions between two along an axis, on the wrapped grid.
uvec3 regionsApart(uvec3 a, uvec3 b) {
  uvec3 apart = max(a, b) - min(a, b);
  return min(apart, regionCounts() - apart);
}
#endif
