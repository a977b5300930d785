// Kernels over samples run where there is fluid alone: a workgroup takes one of the listed blocks
// of kSampleBlock x kSampleBlock samples. Outside of those samples stay as they were cleared.
// Define BLOCKS, the list's binding, before including; needs `counters`. With LEVELS a block has
// half as many samples a side on each coarser level of a pyramid.
#ifdef LEVELS
layout(local_size_x = kSampleBlock, local_size_y = kSampleBlock, local_size_x_id = 1, local_size_y_id = 1) in;
layout(constant_id = 1) const uint kBlock = kSampleBlock;
#else
layout(local_size_x = kSampleBlock, local_size_y = kSampleBlock) in;
const uint kBlock = kSampleBlock;
#endif
layout(std430, set = 0, binding = BLOCKS) readonly buffer Blocks { uint blocks[]; };

// Whether there is one for this invocation.
bool ownSample(out ivec2 at) {
  at = ivec2(0);
  if (groupIndex() >= counters[kSampleBlockCount]) return false;
  const uint block = blocks[groupIndex()];
  const uvec2 grid = sampleGrid();
  const uint columns = (grid.x + kBlock - 1u) / kBlock;
  at = ivec2(uvec2(block % columns, block / columns) * kBlock + gl_LocalInvocationID.xy);
  return at.x < int(grid.x) && at.y < int(grid.y);
}
