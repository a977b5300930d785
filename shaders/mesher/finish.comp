#version 460
// The size of the mesh; empty where it has no room.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"

layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) readonly buffer RowVertices { uint row_vertices[]; };
layout(std430, set = 0, binding = 1) readonly buffer RowTriangles { uint row_triangles[]; };
layout(std430, set = 0, binding = 2) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 3) buffer Arguments { uint arguments[]; };

void put(uint at, uint invocations) {
  const uvec3 groups = foldGroups(divideUp(invocations, kMeshGroup));
  arguments[at] = groups.x;
  arguments[at + 1u] = groups.y;
  arguments[at + 2u] = groups.z;
}

void main() {
  const uint rows = mesh.max_blocks * kBlockRows, vertices = row_vertices[rows], triangles = row_triangles[rows];
  const bool room = vertices <= mesh.max_vertices && triangles <= mesh.max_triangles && counts[kMeshBlocksNeeded] <= mesh.max_blocks;
  counts[kMeshVerticesNeeded] = vertices;
  counts[kMeshTrianglesNeeded] = triangles;
  counts[kMeshVertices] = room ? vertices : 0u;
  counts[kMeshIndexCount] = room ? 3u * triangles : 0u;
  counts[kMeshInstances] = 1u;
  put(kMeshVertexGroups, room ? vertices : 0u);
  put(kMeshOutputGroups, room ? counts[kMeshBlocksNeeded] * kBlockRows : 0u);
}
