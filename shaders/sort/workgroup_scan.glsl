// Exclusive sum over a workgroup at any subgroup size. Define WORKGROUP_SCAN_THREADS, the workgroup's size, before including.
// The partial sums of the subgroups are added up from shared memory by everyone: a scan of them by one subgroup would be wrong
// wherever there are more subgroups than invocations in one (64 subgroups of 4), and a tree would take more barriers.
#ifndef RILL_WORKGROUP_SCAN_GLSL
#define RILL_WORKGROUP_SCAN_GLSL

shared uint subgroupSums[WORKGROUP_SCAN_THREADS];

// The order in which workgroupExclusiveAdd adds: Vulkan leaves open how local indices map to subgroups.
uint scanLane() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// The sum of `value` over the invocations with a smaller scanLane(); `total` is the sum over all. A barrier is needed between two calls.
uint workgroupExclusiveAdd(uint value, out uint total) {
  const uint inclusive = subgroupInclusiveAdd(value);
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u) subgroupSums[gl_SubgroupID] = inclusive;
  barrier();
  uint before = 0u;
  total = 0u;
  for (uint s = 0u; s < gl_NumSubgroups; ++s) {
    const uint sum = subgroupSums[s];
    before += s < gl_SubgroupID ? sum : 0u;
    total += sum;
  }
  return before + inclusive - value;
}

#endif
