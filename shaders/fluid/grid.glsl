// The wrapped grid: cell coordinates modulo a power of two a dimension, so that the domain is unbounded. Cells are kCellsPerReach times narrower in x than in
// y and z: what follows in x is contiguous in the sorted arrays, and narrow cells make its ends fit. Needs `params`.
#ifndef RILL_GRID_GLSL
#define RILL_GRID_GLSL
// Loaded once, see kernel.glsl.
uvec3 gridBits = uvec3(params.gridBitsX, params.gridBitsY, params.gridBitsZ);
uvec3 gridMask = (uvec3(1u) << gridBits) - 1u;
vec3 inverseCell = params.inverseCell * vec3(kCellsPerReach, 1, 1);

uint cellKey(uvec3 cell) { return ((cell.z << gridBits.y | cell.y) << gridBits.x) | cell.x; }

// In cells.
vec3 scaledPosition(vec3 x) { return clamp(x * inverseCell, -1.0e9, 1.0e9); }

uvec3 cellOf(vec3 x) { return uvec3(ivec3(floor(scaledPosition(x)))) & gridMask; }

uvec3 cellFromKey(uint key) {
  return uvec3(key & gridMask.x, key >> gridBits.x & gridMask.y, key >> (gridBits.x + gridBits.y));
}
#endif
