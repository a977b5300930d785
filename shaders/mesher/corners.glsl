// Corners of cells by block and place, the upper ones in the neighbors of the block. The including shader makes neighborsAt() before.

// Index of a corner, each coordinate 0 to kBlockCells; kMeshNone in a block that does not exist.
uint cornerIndex(uint block, uvec3 corner) {
  const uvec3 over = corner / kBlockCells;
  if (over != uvec3(0u)) block = neighborsAt(neighborSlot(block, ivec3(over)));
  return block == kMeshNone ? kMeshNone : block * kBlockCorners + cornerIn(corner - over * kBlockCells);
}
