#version 460
// The triangles of the cells, in the order of the rows.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kMeshGroup) in;
READ_UINT(0, neighbors)
READ_UINT(1, mixed)
READ_UINT(2, cases)
READ_UINT(3, table)
layout(std430, set = 0, binding = 4) readonly buffer RowTriangles { uint row_triangles[]; };
layout(std430, set = 0, binding = 5) readonly buffer FirstVertex { uint first_vertex[]; };
layout(std430, set = 0, binding = 6) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Indices { uint indices[]; };
#include "mesher/corners.glsl"
#include "mesher/crossings.glsl"

// The vertex on an edge of a cell: cubeEdge() of engine/mesher/cube_table.hpp.
uint vertexOn(uint block, uvec3 cell, uint edge) {
  const uint axis = edge / 4u, lower = axis == 0u ? 1u : 0u, higher = axis == 2u ? 1u : 2u;
  uvec3 corner = cell;
  corner[lower] += edge & 1u;
  corner[higher] += edge >> 1u & 1u;
  const uint owner = cornerIndex(block, corner);
  return owner == kMeshNone ? 0u : first_vertex[owner] + uint(bitCount(crossings(casesAt(owner)) & ((1u << axis) - 1u)));
}

void main() {
  const uint row = flatInvocation(), block = row / kBlockRows;
  if (block >= counts[kMeshBlocksNeeded]) return;
  uint next = row_triangles[row];
  if (next == row_triangles[row + 1u]) return;
  const uvec2 at = uvec2(row % kBlockRows / kBlockCells, row % kBlockCells);
  for (uint z = 0u; z < kBlockCells; ++z) {
    const uvec3 cell = uvec3(at, z);
    if (mixedAt(block * kMeshBlockBins + binIn(cell / BIN_CELLS)) == 0u) continue;
    const uint inside = casesAt(block * kBlockCorners + cornerIn(cell)), low = tableAt(2u * inside), high = tableAt(2u * inside + 1u);
    for (uint k = 0u; k < 3u * (high >> 28u); ++k)
      indices[3u * next + k] = vertexOn(block, cell, (k < 8u ? low >> 4u * k : high >> 4u * (k - 8u)) & 15u);
    next += high >> 28u;
  }
}
