// Place of a key among the blocks, which are sorted; kMeshNone if it is not there. The including shader declares `blocks` and `counts`.
uint findBlock(uint key) {
  const uint count = counts[kMeshBlocksNeeded] <= mesh.max_blocks ? counts[kMeshBlocksNeeded] : 0u;
  uint low = 0u, high = count;
  for (uint k = 0u; k < 32u && low < high; ++k) {
    const uint middle = (low + high) / 2u;
    if (blocks[middle] < key)
      low = middle + 1u;
    else
      high = middle;
  }
  return low < count && blocks[low] == key ? low : kMeshNone;
}
