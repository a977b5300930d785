#version 460
// Lists the particles whose kernels reach a bin near the surface, in the order of a walk. The sums at all corners and vertices of the bin
// are over its list, or by a walk where it has none. Lists are used only if all have room, so that bits do not depend on who came first.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kMeshGroup) in;
READ_UINT(0, start)
READ_UINT(1, neighbors)
READ_FLOAT4(2, ellipsoids)
READ_UINT(3, near_bins)
READ_UINT(4, blocks)
layout(std430, set = 0, binding = 5) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 6) writeonly buffer BinLists { uvec2 bin_lists[]; };  // place of the first entry and their number
layout(std430, set = 0, binding = 7) writeonly buffer Lists { uint lists[]; };
#include "mesher/walk.glsl"

const float kMargin = 1e-2;  // squared spacings: what a sum may round
vec3 middle;
uint found[kMeshMaxListed];
uint count = 0u;

void visit(uint slot) {
  const vec4 sphere = ellipsoidsAt(3u * slot);
  const vec3 outside = max(abs(sphere.xyz - middle) - 0.5 * binSide(), 0.0);
  if (dot(outside, outside) >= sphere.w + kMargin) return;
  if (count < kMeshMaxListed) found[count] = slot;
  ++count;
}

void main() {
  const uint k = flatInvocation();
  if (k >= counts[kMeshNearBins]) return;
  const uint i = near_binsAt(k), block = i / kMeshBlockBins;
  const ivec3 bin = ivec3(binOf(i % kMeshBlockBins));
  middle = (vec3(4 * blockOf(blocksAt(block)) + bin) + 0.5) * binSide();
  const bool listed = walk(block, bin, binSide(), kMeshReach) && count <= kMeshMaxListed;
  const uint first = listed ? atomicAdd(counts[kMeshListed], count) : 0u;
  for (uint n = 0u; n < count && listed && first + n < mesh.max_listed; ++n) lists[first + n] = found[n];
  bin_lists[i] = uvec2(first, listed ? count : kMeshNone);
}
