#version 460
// Position, normal and velocity of each vertex: from its edge, the slope of the sum of kernels, and their mean over particles.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kMeshGroup) in;
READ_UINT(0, blocks)
READ_UINT(1, start)
READ_UINT(2, neighbors)
READ_FLOAT4(3, ellipsoids)
layout(std430, set = 0, binding = 4) readonly buffer Field { float field[]; };
READ_UINT(5, edges)
READ_UINT(6, order)
READ_FLOAT4(7, velocity)
READ_UINT2(8, bin_lists)
READ_UINT(9, lists)
layout(std430, set = 0, binding = 10) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 11) writeonly buffer VertexPosition { vec4 vertex_position[]; };
layout(std430, set = 0, binding = 12) writeonly buffer VertexNormal { vec4 vertex_normal[]; };
layout(std430, set = 0, binding = 13) writeonly buffer VertexVelocity { vec4 vertex_velocity[]; };
#include "mesher/corners.glsl"
#include "mesher/mesh_kernel.glsl"
#include "mesher/near.glsl"

vec3 point;
float sum = 0.0;
vec3 slope = vec3(0.0), moved = vec3(0.0);

void visit(uint slot) {
  const vec4 sphere = ellipsoidsAt(3u * slot);
  const vec3 to = point - sphere.xyz;
  if (dot(to, to) >= sphere.w) return;
  const vec4 a = ellipsoidsAt(3u * slot + 1u);
  const vec3 b = ellipsoidsAt(3u * slot + 2u).xyz;
  const mat3 toKernel = mat3(a.xyz, vec3(a.y, b.xy), vec3(a.z, b.yz));
  const vec3 inner = toKernel * to;
  const float r = length(inner), value = a.w * meshKernel(r);
  if (value == 0.0) return;
  sum += value;
  slope += a.w * meshKernelSlope(r) / max(r, 1e-6) * (toKernel * inner);
  if (mesh.velocities != 0u) moved += value * velocityAt(orderAt(slot)).xyz;
}

void main() {
  const uint i = flatInvocation();
  if (i >= counts[kMeshVertices]) return;
  const uint edge = edgesAt(i), axis = edge & 3u, from = edge >> 2u, block = from / kBlockCorners;
  const uvec3 corner = cornerOf(from % kBlockCorners);
  uvec3 step = uvec3(0u);
  step[axis] = 1u;
  const uint to = cornerIndex(block, corner + step);
  const float a = field[from], b = to == kMeshNone ? 1.0 : field[to];
  const float t = clamp(a / (a - b), kMeshEdgeMargin, 1.0 - kMeshEdgeMargin);
  const vec3 base = vec3(blockOf(blocksAt(block)) * int(kBlockCells) + ivec3(corner)) * mesh.cell, along = vec3(step) * mesh.cell;
  point = base + t * along;
  if (!visitNear(block, corner / BIN_CELLS)) atomicAdd(counts[kMeshBoundHits], 1u);

  // One step of Newton's method along the edge
  const float change = dot(slope, along), refined = abs(change) > 1e-3 ? t + (0.5 - sum) / change : t;
  const float steep = length(slope);
  vertex_position[i] = vec4((base + clamp(refined, kMeshEdgeMargin, 1.0 - kMeshEdgeMargin) * along) * mesh.spacing, 1.0);
  vertex_normal[i] = vec4(steep > 1e-6 ? -slope / steep : vec3(0.0, 1.0, 0.0), 0.0);
  vertex_velocity[i] = vec4(sum > 1e-6 ? moved / sum : vec3(0.0), 0.0);
}
