#version 460
// Lists the tiles of the picture with a covered sample in or next to them, and the blocks with a covered sample.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Blocks { uint blocks[]; };

// Among the samples from `first` to `last`.
bool anyCovered(ivec2 first, ivec2 last) {
  const uint columns = sampleGrid().x;
  bool any_covered = false;
  for (int y = first.y; y <= last.y && !any_covered; ++y)
    for (int x = first.x; x <= last.x && !any_covered; ++x) any_covered = depth[uint(y) * columns + uint(x)] != kNoDepthBits;
  return any_covered;
}

void listBlock(uint block) {
  const uvec2 samples = sampleGrid(), grid = (samples + kSampleBlock - 1u) / kSampleBlock;
  if (block >= grid.x * grid.y) return;
  const ivec2 first = ivec2(block % grid.x, block / grid.x) * int(kSampleBlock);
  if (anyCovered(first, min(first + int(kSampleBlock), ivec2(samples)) - 1)) blocks[atomicAdd(counters[kSampleBlockCount], 1u)] = block;
}

void listTile(uint tile) {
  const uvec2 grid = (uvec2(view.width, view.height) + kSurfaceTile - 1u) / kSurfaceTile;
  if (tile >= grid.x * grid.y) return;
  const uvec2 samples = sampleGrid();
  const ivec2 pixel = ivec2(tile % grid.x, tile / grid.x) * int(kSurfaceTile);
  const ivec2 first = pixel / int(view.step) - 1 + int(view.margin);
  const ivec2 last = min((pixel + int(kSurfaceTile) - 1) / int(view.step) + 1 + int(view.margin), ivec2(samples) - 1);
  if (anyCovered(first, last)) tiles[atomicAdd(counters[kSurfaceTileCount], 1u)] = tile;
}

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  listTile(k);
  listBlock(k);
}
