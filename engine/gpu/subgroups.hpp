#pragma once
// How many invocations work together, on devices whose subgroups differ.
#include <cstdint>

#include "rill/device.hpp"

namespace rill {

/// What a pipeline asks of its subgroups.
struct SubgroupNeed {
  uint32_t size = 0;  ///< that it requires; 0: any
  bool full = false;  ///< no invocation is missing, and consecutive ones share a subgroup
  friend bool operator==(const SubgroupNeed&, const SubgroupNeed&) = default;
};

/// For passes whose invocations work together in clusters (shaders/fluid/cluster.glsl).
struct ClusterChoice {
  SubgroupNeed need;
  uint32_t cluster = 0;  ///< invocations, a power of two that divides every size that the subgroup may have
};

/// A cluster of 0 if the device cannot do it: its subgroups may be larger than `workgroup`, and no size can be required. Without control
/// over the size, clusters are as for the smallest size that the device may take. With it, subgroups are of 32, or 16 on Intel, whose
/// compilers spill registers at 32; as near to that as the device goes. Clusters are of 8 in subgroups of 32 or more, else subgroups.
ClusterChoice chooseCluster(const DeviceInfo& info, bool canRequireSize, uint32_t vendor, uint32_t workgroup);

/// Full subgroups of any size, if these divide the workgroup; else no need.
SubgroupNeed fullSubgroups(const DeviceInfo& info, uint32_t workgroup);

/// For passes of the same shaders that have no clusters: full subgroups of any size, where those can be had without requiring one.
SubgroupNeed withoutCluster(const DeviceInfo& info, const ClusterChoice& choice, uint32_t workgroup);

}  // namespace rill
