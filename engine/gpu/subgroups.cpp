#include "gpu/subgroups.hpp"

#include <algorithm>
#include <bit>

namespace rill {
namespace {

/// Particles of wide clusters lie in many rows of cells, which all of a cluster walk (docs/notes/gpu-correctness.md).
uint32_t clusterIn(uint32_t subgroup) { return subgroup >= 32 ? 8 : std::bit_floor(subgroup); }

}  // namespace

ClusterChoice chooseCluster(const DeviceInfo& info, bool canRequireSize, uint32_t vendor, uint32_t workgroup) {
  constexpr uint32_t kIntel = 0x8086;
  const uint32_t smallest = std::max(info.minSubgroupSize, 1u), largest = std::max(std::min(info.maxSubgroupSize, workgroup), smallest);
  if (canRequireSize) {
    if (smallest > workgroup) return {};
    const uint32_t size = std::clamp(vendor == kIntel ? 16u : 32u, smallest, largest);
    return {{size, true}, clusterIn(size)};
  }
  if (!fullSubgroups(info, workgroup).full) return {};
  return {{0, true}, clusterIn(smallest)};
}

SubgroupNeed fullSubgroups(const DeviceInfo& info, uint32_t workgroup) { return {0, workgroup % std::max(info.maxSubgroupSize, 1u) == 0}; }

SubgroupNeed withoutCluster(const DeviceInfo& info, const ClusterChoice& choice, uint32_t workgroup) {
  const SubgroupNeed any = fullSubgroups(info, workgroup);
  return any.full ? any : choice.need;
}

}  // namespace rill
