#include "gpu/subgroups.hpp"

#include <algorithm>
#include <bit>

namespace rill {

ClusterChoice chooseCluster(const DeviceInfo& info, bool canRequireSize, uint32_t vendor, uint32_t workgroup) {
  constexpr uint32_t kIntel = 0x8086, kMaxCluster = 32;  // see cluster.glsl: a window of candidates has as many
  const uint32_t smallest = std::max(info.minSubgroupSize, 1u), largest = std::max(std::min(info.maxSubgroupSize, workgroup), smallest);
  if (canRequireSize) {
    const uint32_t size = std::clamp(vendor == kIntel ? 16u : 32u, smallest, largest);
    return {{size, true}, std::min(size, kMaxCluster)};
  }
  if (workgroup % std::max(info.maxSubgroupSize, 1u) != 0) return {};
  return {{0, true}, std::min(std::bit_floor(smallest), kMaxCluster)};
}

SubgroupNeed withoutCluster(const DeviceInfo& info, const ClusterChoice& choice, uint32_t workgroup) {
  return workgroup % std::max(info.maxSubgroupSize, 1u) == 0 ? SubgroupNeed{0, true} : choice.need;
}

}  // namespace rill
