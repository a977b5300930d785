// What passes of the surface mesher share: blocks, bins and corners of the sparse grid. Lengths are in spacings.
#ifndef RILL_MESHER_GLSL
#define RILL_MESHER_GLSL
#include "shared/dispatch.glsl"
#include "mesher/mesher_records.h"

layout(constant_id = 0) const uint BIN_CELLS = 2u;  // cells along a bin
const uint kBlockCells = 4u * BIN_CELLS;            // along a block
const uint kBinCorners = BIN_CELLS * BIN_CELLS * BIN_CELLS;
const uint kBlockRows = kBlockCells * kBlockCells;
const uint kBlockCorners = kBlockRows * kBlockCells;

layout(push_constant) uniform PushBlock { MeshPush mesh; };

float binSide() { return float(BIN_CELLS) * mesh.cell; }
ivec3 binAt(vec3 x) { return ivec3(floor(x / binSide())); }

// Whether a block lies in the grid, with its neighbors.
bool inGrid(ivec3 block) {
  const ivec3 most = ivec3(kMeshHalfX, kMeshHalfY, kMeshHalfX) - 3;
  return all(lessThanEqual(abs(block), most));
}
// Ascending in x, then y, then z.
uint keyOf(ivec3 block) {
  const uvec3 b = uvec3(block + ivec3(kMeshHalfX, kMeshHalfY, kMeshHalfX));
  return b.x << 21u | b.y << 11u | b.z;
}
ivec3 blockOf(uint key) {
  return ivec3(key >> 21u, key >> 11u & 1023u, key & 2047u) - ivec3(kMeshHalfX, kMeshHalfY, kMeshHalfX);
}

uint binIn(uvec3 bin) { return bin.x << 4u | bin.y << 2u | bin.z; }
uvec3 binOf(uint bin) { return uvec3(bin >> 4u, bin >> 2u & 3u, bin & 3u); }

// A corner's place in the arrays of a block: corners of a bin lie together.
uint cornerIn(uvec3 corner) {
  const uvec3 bin = corner / BIN_CELLS, at = corner % BIN_CELLS;
  return binIn(bin) * kBinCorners + (at.x * BIN_CELLS + at.y) * BIN_CELLS + at.z;
}
uvec3 cornerOf(uint index) {
  const uint at = index % kBinCorners;
  return binOf(index / kBinCorners) * BIN_CELLS + uvec3(at / (BIN_CELLS * BIN_CELLS), at / BIN_CELLS % BIN_CELLS, at % BIN_CELLS);
}
uint neighborSlot(uint block, ivec3 to) { return block * kMeshNeighbors + uint((to.x + 1) * 9 + (to.y + 1) * 3 + to.z + 1); }
#endif
