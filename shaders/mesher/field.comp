#version 460
// Signed distance to the surface at each corner of the bins near it, in spacings, at most 1: from the sum of the particles' kernels.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kMeshGroup) in;
READ_UINT(0, blocks)
READ_UINT(1, start)
READ_UINT(2, neighbors)
READ_FLOAT4(3, ellipsoids)
READ_UINT(4, near_bins)
READ_UINT2(5, bin_lists)
READ_UINT(6, lists)
layout(std430, set = 0, binding = 7) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 8) writeonly buffer Field { float field[]; };
#include "mesher/mesh_kernel.glsl"
#include "mesher/near.glsl"

vec3 point;
float sum = 0.0;

void visit(uint slot) {
  const vec4 sphere = ellipsoidsAt(3u * slot);
  const vec3 to = point - sphere.xyz;
  if (dot(to, to) >= sphere.w) return;
  const vec4 a = ellipsoidsAt(3u * slot + 1u);
  const vec3 b = ellipsoidsAt(3u * slot + 2u).xyz;
  sum += a.w * meshKernel(length(vec3(dot(a.xyz, to), dot(vec3(a.y, b.xy), to), dot(vec3(a.z, b.yz), to))));
}

void main() {
  const uint k = flatInvocation();
  if (k / kBinCorners >= counts[kMeshNearBins]) return;
  const uint bin = near_binsAt(k / kBinCorners), block = bin / kMeshBlockBins, i = bin * kBinCorners + k % kBinCorners;
  point = vec3(blockOf(blocksAt(block)) * int(kBlockCells) + ivec3(cornerOf(i % kBlockCorners))) * mesh.cell;
  if (!visitNear(block, binOf(bin % kMeshBlockBins))) atomicAdd(counts[kMeshBoundHits], 1u);
  field[i] = meshDistance(sum);
}
