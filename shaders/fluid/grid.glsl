// The wrapped grid: cell coordinates modulo its size a dimension, so that the domain is unbounded.
// Cells are kCellsPerReach times narrower in x than in y and z: what follows in x is contiguous in
// the sorted arrays, and narrow cells make its ends fit. Needs `params`.
#ifndef RILL_GRID_GLSL
#define RILL_GRID_GLSL
// Loaded once, see kernel.glsl.
vec3 gridSize = vec3(params.gridSizeX, params.gridSizeY, params.gridSizeZ);
vec3 inverseGridSize = 1.0 / gridSize;
vec3 inverseCell = params.inverseCell * vec3(kCellsPerReach, 1, 1);

const float kFarthestCell = 8388608.0;  // from there on a float knows no halves of cells

// In cells.
vec3 scaledPosition(vec3 x) { return clamp(x * inverseCell, -kFarthestCell, kFarthestCell); }

// Whole `cell`, at most a few beyond the farthest, modulo the grid's size. In floats, of which
// lavapipe takes eight at a time; exact: only the quotient may be off, by one.
vec3 wrapped(vec3 cell) {
  vec3 rest = cell - gridSize * floor(cell * inverseGridSize);
  return rest + mix(vec3(0), gridSize, lessThan(rest, vec3(0))) - mix(vec3(0), gridSize, greaterThanEqual(rest, gridSize));
}

// Of a wrapped cell; of anything else, NaN too, some cell's.
uint cellKey(vec3 cell) {
  uvec3 size = uvec3(gridSize), c = min(uvec3(cell), size - 1u);
  return (c.z * size.y + c.y) * size.x + c.x;
}

uint cellCount() { return params.gridSizeX * params.gridSizeY * params.gridSizeZ; }

vec3 cellOf(vec3 x) { return wrapped(floor(scaledPosition(x))); }

vec3 cellFromKey(uint key) {
  uvec3 size = uvec3(gridSize);
  uint row = key / size.x;
  return vec3(key - row * size.x, row % size.y, row / size.y);
}
#endif
