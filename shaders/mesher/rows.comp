#version 460
// The case of each cell (cubeTriangles()), and how many vertices and triangles a row of cells along z has. A vertex belongs to the cell
// at the lower end of its edge.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kMeshGroup) in;
READ_UINT(0, neighbors)
READ_UINT(1, mixed)
READ_FLOAT(2, field)
layout(std430, set = 0, binding = 3) readonly buffer Table { uint table[]; };
layout(std430, set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Cases { uint cases[]; };
layout(std430, set = 0, binding = 6) writeonly buffer RowVertices { uint row_vertices[]; };
layout(std430, set = 0, binding = 7) writeonly buffer RowTriangles { uint row_triangles[]; };
#include "mesher/corners.glsl"
#include "mesher/crossings.glsl"

uint insideAt(uint block, uvec3 corner) {
  const uint index = cornerIndex(block, corner);
  return index != kMeshNone && fieldAt(index) < 0.0 ? 1u : 0u;
}
// Bits 0 to 3: the corners of a cell's lower side along z.
uint slice(uint block, uvec3 corner) {
  return insideAt(block, corner) | insideAt(block, corner + uvec3(1u, 0u, 0u)) << 1u | insideAt(block, corner + uvec3(0u, 1u, 0u)) << 2u |
         insideAt(block, corner + uvec3(1u, 1u, 0u)) << 3u;
}

void main() {
  const uint row = flatInvocation(), block = row / kBlockRows;
  if (block >= counts[kMeshBlocksNeeded]) return;
  const uvec2 at = uvec2(row % kBlockRows / kBlockCells, row % kBlockCells);
  uint vertices = 0u, triangles = 0u;
  for (uint bin = 0u; bin < 4u; ++bin) {
    if (mixedAt(block * kMeshBlockBins + binIn(uvec3(at / BIN_CELLS, bin))) == 0u) continue;
    uint lower = slice(block, uvec3(at, bin * BIN_CELLS));
    for (uint k = 0u; k < BIN_CELLS; ++k) {
      const uvec3 cell = uvec3(at, bin * BIN_CELLS + k);
      const uint upper = slice(block, cell + uvec3(0u, 0u, 1u)), inside = lower | upper << 4u;
      cases[block * kBlockCorners + cornerIn(cell)] = inside;
      vertices += uint(bitCount(crossings(inside)));
      triangles += table[2u * inside + 1u] >> 28u;
      lower = upper;
    }
  }
  row_vertices[row] = vertices;
  row_triangles[row] = triangles;
}
