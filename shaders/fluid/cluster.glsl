// Clusters: CLUSTER consecutive particles of the sorted arrays, one a lane, that walk the grid together: each lane fetches one candidate, and a shuffle shows it
// to all (Pall and Hess 2013, for pairs of atoms). Needs dispatch.glsl and, in the shader, GL_KHR_shader_subgroup_basic and _shuffle; its pipeline must ask for
// full subgroups.
#ifndef RILL_CLUSTER_GLSL
#define RILL_CLUSTER_GLSL
layout(constant_id = 1) const uint CLUSTER = 8;  // 4 or 8, at most a subgroup

uint clusterLane = gl_SubgroupInvocationID & (CLUSTER - 1u);

// The invocation's place in a folded dispatch, counted so that a cluster never leaves its subgroup.
uint clusterInvocation() { return flatGroup() * kFluidGroup + gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// `value` of the cluster's lane `lane`.
#define SPREAD(value, lane) subgroupShuffle(value, gl_SubgroupInvocationID - clusterLane + (lane))

#define CLUSTER_REDUCE(name, type, combine)                                     \
  type name(type v) {                                                           \
    v = combine(v, subgroupShuffleXor(v, 1u));                                  \
    v = combine(v, subgroupShuffleXor(v, 2u));                                  \
    return CLUSTER > 4u ? combine(v, subgroupShuffleXor(v, 4u)) : v;            \
  }
CLUSTER_REDUCE(clusterMin, uint, min)
CLUSTER_REDUCE(clusterMin, vec3, min)
CLUSTER_REDUCE(clusterMax, vec3, max)
#endif
