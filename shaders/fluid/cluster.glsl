// Clusters: CLUSTER consecutive particles of the sorted arrays, one a lane of a subgroup, that walk
// the grid together: each lane fetches one candidate and broadcasts it by a shuffle (Pall and Hess
// 2013, for pairs of atoms). Needs dispatch.glsl and, in the shader, GL_KHR_shader_subgroup_basic,
// _vote and _shuffle; its pipeline must ask for full subgroups.
#ifndef RILL_CLUSTER_GLSL
#define RILL_CLUSTER_GLSL

uint clusterLane = gl_SubgroupInvocationID & (CLUSTER - 1u);

// The invocation's place in a folded dispatch, counted so that a cluster never leaves its subgroup.
uint clusterInvocation() { return flatGroup() * kFluidGroup + gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// `value` of the cluster's lane `lane`.
#define SPREAD(value, lane) subgroupShuffle(value, gl_SubgroupInvocationID - clusterLane + (lane))

// Whether any lane of the subgroup has `more` to do. Loops around shuffles go on until none has: lanes
// that leave a loop before others of their subgroup need not come together again, not even in a cluster.
#ifndef ANY_LANE
#define ANY_LANE(more) mix(more, subgroupAny(more), gl_SubgroupSize != CLUSTER)
#endif

#define CLUSTER_REDUCE(name, type, combine)                                                                  \
  type name(type v) {                                                                                        \
    for (uint far = 1u; far < CLUSTER; far *= 2u) v = combine(v, subgroupShuffleXor(v, far));                \
    return v;                                                                                                \
  }
CLUSTER_REDUCE(clusterMin, uint, min)
CLUSTER_REDUCE(clusterMin, vec3, min)
CLUSTER_REDUCE(clusterMax, vec3, max)
#endif
