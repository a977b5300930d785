#version 460
// The first vertex of each cell, and the edge of each vertex: the cell's index times four, and the axis.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = kMeshGroup) in;
layout(std430, set = 0, binding = 0) readonly buffer Mixed { uint mixed[]; };
layout(std430, set = 0, binding = 1) readonly buffer Cases { uint cases[]; };
layout(std430, set = 0, binding = 2) readonly buffer RowVertices { uint row_vertices[]; };
layout(std430, set = 0, binding = 3) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 4) writeonly buffer FirstVertex { uint first_vertex[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Edges { uint edges[]; };
#include "mesher/crossings.glsl"

void main() {
  const uint row = flatInvocation(), block = row / kBlockRows;
  if (block >= counts[kMeshBlocksNeeded]) return;
  uint next = row_vertices[row];
  if (next == row_vertices[row + 1u]) return;
  const uvec2 at = uvec2(row % kBlockRows / kBlockCells, row % kBlockCells);
  for (uint z = 0u; z < kBlockCells; ++z) {
    if (mixed[block * kMeshBlockBins + binIn(uvec3(at, z) / BIN_CELLS)] == 0u) continue;
    const uint cell = block * kBlockCorners + cornerIn(uvec3(at, z)), crossed = crossings(cases[cell]);
    first_vertex[cell] = next;
    for (uint axis = 0u; axis < 3u; ++axis)
      if ((crossed >> axis & 1u) != 0u) edges[next++] = cell << 2u | axis;
  }
}
