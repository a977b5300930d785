#version 460
// The ellipsoid of each particle: ellipsoids() of engine/reference/surface_mesh.hpp.
#extension GL_GOOGLE_include_directive : require
#include "mesher/mesher.glsl"
#include "shared/arrays.glsl"

layout(local_size_x = kMeshGroup) in;
READ_UINT4(0, places)
READ_UINT(1, start)
READ_UINT(2, neighbors)
// Three a particle: center and squared radius; xx, xy, xz of the matrix to the kernel and the amplitude; yy, yz, zz.
layout(std430, set = 0, binding = 3) writeonly buffer Ellipsoids { vec4 ellipsoids[]; };
layout(std430, set = 0, binding = 4) buffer Surface { uint surface[]; };
layout(std430, set = 0, binding = 5) buffer Counts { uint counts[]; };
#include "mesher/mesh_kernel.glsl"
#include "mesher/walk.glsl"

vec3 center;
float weights = 0.0, sum = 0.0;
vec3 first = vec3(0.0), straight = vec3(0.0), mixed = vec3(0.0);  // mixed: xy, xz, yz

void visit(uint slot) {
  const vec3 to = uintBitsToFloat(placesAt(slot).xyz) - center;
  const float square = dot(to, to);
  if (square >= kMeshFitRadius * kMeshFitRadius) return;
  const float r = sqrt(square), part = r / kMeshFitRadius, weight = 1.0 - part * part * part;
  weights += weight;
  sum += meshKernel(r);
  first += weight * to;
  straight += weight * to * to;
  mixed += weight * to.xxy * to.yzz;
}

// A Jacobi rotation in the plane of axes p and q, of a symmetric matrix and of the axes so far.
void rotate(inout mat3 a, inout mat3 v, int p, int q) {
  if (abs(a[p][q]) < 1e-12) return;
  const float theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
  const float t = (theta < 0.0 ? -1.0 : 1.0) / (abs(theta) + sqrt(theta * theta + 1.0)), c = inversesqrt(t * t + 1.0), s = t * c;
  mat3 turn = mat3(1.0);
  turn[p][p] = turn[q][q] = c;
  turn[q][p] = s;
  turn[p][q] = -s;
  a = transpose(turn) * a * turn;
  v = v * turn;
}

void swapIfLess(inout vec3 values, inout mat3 axes, int i, int j) {
  if (values[i] >= values[j]) return;
  const float value = values[i];
  values[i] = values[j];
  values[j] = value;
  const vec3 axis = axes[i];
  axes[i] = axes[j];
  axes[j] = axis;
}

void main() {
  const uint slot = flatInvocation();
  if (slot >= startAt(mesh.max_blocks * kMeshBlockBins)) return;
  center = uintBitsToFloat(placesAt(slot).xyz);
  const uint bin = placesAt(slot).w;
  if (!walk(bin / kMeshBlockBins, ivec3(binOf(bin % kMeshBlockBins)), binSide(), kMeshFitRadius)) atomicAdd(counts[kMeshBoundHits], 1u);

  const vec3 mean = first / max(weights, 1e-6);
  if (length(mean) > kMeshDeepOffset || weights < kMeshDeepWeight) atomicOr(surface[bin], 1u);
  straight = straight / max(weights, 1e-6) - mean * mean;
  mixed = mixed / max(weights, 1e-6) - mean.xxy * mean.yzz;
  mat3 a = mat3(vec3(straight.x, mixed.xy), vec3(mixed.x, straight.y, mixed.z), vec3(mixed.yz, straight.z)), axes = mat3(1.0);
  for (uint sweep = 0u; sweep < kMeshSweeps; ++sweep) {
    rotate(a, axes, 0, 1);
    rotate(a, axes, 0, 2);
    rotate(a, axes, 1, 2);
  }
  vec3 values = vec3(a[0][0], a[1][1], a[2][2]);
  swapIfLess(values, axes, 0, 1);
  swapIfLess(values, axes, 1, 2);
  swapIfLess(values, axes, 0, 1);

  const float aside = length(mean - dot(mean, axes[2]) * axes[2]) - kMeshRimOffset;
  const float rim = kMeshRim * max(aside, 0.0) * (1.0 - smoothstep(0.0, kMeshAlong, values.z));
  const float few = clamp(pow(kMeshSheetSum / max(sum, 1e-6), kMeshPower), 1.0, kMeshMaxAmplitude);
  vec3 scale = vec3(1.0);
  for (int k = 0; k < 2; ++k)
    scale[k] += (kMeshStretch - 1.0) * (1.0 - smoothstep(kMeshFlat, kMeshRound, max(values.z, 0.0) / max(values[k], 1e-9))) *
                smoothstep(0.0, kMeshAlong, values[k]);
  const mat3 across = outerProduct(axes[0], axes[0]) / scale.x + outerProduct(axes[1], axes[1]) / scale.y;
  const mat3 toKernel = across + outerProduct(axes[2], axes[2]);
  const float radius = 1.5 * max(scale.x, scale.y);
  ellipsoids[3u * slot] = vec4(center, radius * radius);
  ellipsoids[3u * slot + 1u] = vec4(toKernel[0], min(few * (1.0 + rim), kMeshMaxAmplitude) / (scale.x * scale.y));
  ellipsoids[3u * slot + 2u] = vec4(toKernel[1].yz, toKernel[2].z, 0.0);
}
