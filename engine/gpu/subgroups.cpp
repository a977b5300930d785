#include "gpu/subgroups.hpp"

#include <algorithm>
#include <bit>

namespace rill {

ClusterChoice chooseCluster(const DeviceInfo& info, bool canRequireSize, uint32_t vendor, uint32_t workgroup) {
  constexpr uint32_t kIntel = 0x8086, kMaxCluster = 32;  // see cluster.glsl: a window of candidates has as many
  const uint32_t smallest = std::max(info.minSubgroupSize, 1u), largest = std::max(std::min(info.maxSubgroupSize, workgroup), smallest);
  if (canRequireSize) {
    if (smallest > workgroup) return {};
    const uint32_t size = std::clamp(vendor == kIntel ? 16u : 32u, smallest, largest);
    return {{size, true}, std::min(size, kMaxCluster)};
  }
  if (!fullSubgroups(info, workgroup).full) return {};
  return {{0, true}, std::min(std::bit_floor(smallest), kMaxCluster)};
}

SubgroupNeed fullSubgroups(const DeviceInfo& info, uint32_t workgroup) { return {0, workgroup % std::max(info.maxSubgroupSize, 1u) == 0}; }

SubgroupNeed withoutCluster(const DeviceInfo& info, const ClusterChoice& choice, uint32_t workgroup) {
  const SubgroupNeed any = fullSubgroups(info, workgroup);
  return any.full ? any : choice.need;
}

}  // namespace rill
