// Exclusive prefix sum over a workgroup, for any subgroup size. Define WORKGROUP_SCAN_THREADS, the workgroup
// size, before including. Subgroup sums are added in shared memory by one invocation per subgroup: a single
// subgroup scan fails if there are more subgroups than lanes (64 subgroups of 4).
#ifndef RILL_WORKGROUP_SCAN_GLSL
#define RILL_WORKGROUP_SCAN_GLSL

shared uint subgroupSums[WORKGROUP_SCAN_THREADS];
shared uint subgroupOffsets[WORKGROUP_SCAN_THREADS + 1u];

// The position in the order of summation. Vulkan does not define how local indices map to subgroups.
uint scanLane() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// The sum of `value` over all invocations with a smaller scanLane(); `total` is the sum over the workgroup.
// Two calls need a barrier between them.
uint workgroupExclusiveAdd(uint value, out uint total) {
  const uint inclusive = subgroupInclusiveAdd(value);
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u) subgroupSums[gl_SubgroupID] = inclusive;
  barrier();
  const uint mine = gl_LocalInvocationIndex;
  if (mine <= gl_NumSubgroups) {
    uint before = 0u;
    for (uint s = 0u; s < mine; ++s) before += subgroupSums[s];
    subgroupOffsets[mine] = before;
  }
  barrier();
  total = subgroupOffsets[gl_NumSubgroups];
  return subgroupOffsets[gl_SubgroupID] + inclusive - value;
}

#endif
