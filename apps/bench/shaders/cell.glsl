// Keys are x-major: three neighboring cells along x are one contiguous range of the sorted arrays.
ivec3 cells() { return ivec3(push.cellsX, push.cellsY, push.cellsZ); }
ivec3 cellOf(vec3 x) { return clamp(ivec3(floor(x / push.radius)), ivec3(0), cells() - 1); }
uint cellKey(ivec3 cell) { return uint((cell.z * cells().y + cell.y) * cells().x + cell.x); }
