// A workgroup processes one listed block of kSampleBlock x kSampleBlock samples; samples of other blocks keep their cleared value.
// BLOCKS is the list's binding; needs `counters`. With LEVELS, blocks halve on each coarser level of the pyramid.
#ifdef LEVELS
layout(local_size_x = kSampleBlock, local_size_y = kSampleBlock, local_size_x_id = 1, local_size_y_id = 1) in;
layout(constant_id = 1) const uint kBlock = kSampleBlock;
#else
layout(local_size_x = kSampleBlock, local_size_y = kSampleBlock) in;
const uint kBlock = kSampleBlock;
#endif
layout(std430, set = 0, binding = BLOCKS) readonly buffer Blocks { uint blocks[]; };

// The sample of this invocation; false if it has none.
bool ownSample(out ivec2 at) {
  at = ivec2(0);
  if (groupIndex() >= counters[kSampleBlockCount]) return false;
  const uint block = blocks[groupIndex()];
  const uvec2 grid = sampleGrid();
  const uint columns = (grid.x + kBlock - 1u) / kBlock;
  at = ivec2(uvec2(block % columns, block / columns) * kBlock + gl_LocalInvocationID.xy);
  return at.x < int(grid.x) && at.y < int(grid.y);
}
