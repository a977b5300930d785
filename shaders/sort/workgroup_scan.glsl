// Exclusive sum over a workgroup at any subgroup size. Define WORKGROUP_SCAN_THREADS, the workgroup's size, before including.
// The subgroups' sums are added up by one invocation each, from shared memory: a scan of them by one subgroup would be wrong
// wherever there are more subgroups than invocations in one (64 subgroups of 4).
#ifndef RILL_WORKGROUP_SCAN_GLSL
#define RILL_WORKGROUP_SCAN_GLSL

shared uint subgroupSums[WORKGROUP_SCAN_THREADS];
shared uint subgroupOffsets[WORKGROUP_SCAN_THREADS + 1u];

// The order in which workgroupExclusiveAdd adds: Vulkan leaves open how local indices map to subgroups.
uint scanLane() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// The sum of `value` over the invocations with a smaller scanLane(); `total` is the sum over all. A barrier is needed between two calls.
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
