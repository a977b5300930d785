#include "bench/device/description.hpp"

#include <utility>

#include "core/impl_of.hpp"
#include "core/words.hpp"
#include "gpu/device_impl.hpp"
#include "gpu/subgroups.hpp"
#include "gpu/vulkan_error.hpp"
#include "shared/fluid_records.h"

namespace rill::bench {
namespace {

std::string subgroupSizes(const DeviceInfo& info) {
  return std::to_string(info.minSubgroupSize) + " to " + std::to_string(info.maxSubgroupSize);
}

Table limitsTable(const DeviceImpl& device, uint64_t availableBytes, const ClusterChoice& cluster) {
  const DeviceInfo& info = device.info;
  const VkPhysicalDeviceLimits& limits = device.limits;
  Table table{"Device, limits and chosen variants", {"what", "value"}, {}, ""};
  const auto add = [&](const char* what, std::string value) { table.rows.push_back({what, std::move(value)}); };
  add("device", info.name);
  add("driver", info.driver);
  add("Vulkan", info.api);
  add("device memory", bytesText(info.deviceLocalBytes) + ", available " + bytesText(availableBytes));
  add("largest buffer", bytesText(info.maxBufferBytes) + " (" + std::string(info.maxBufferName) + ")");
  add("texels of a buffer", grouped(info.maxTexelBufferElements));
  add("workgroup",
      grouped(limits.maxComputeWorkGroupInvocations) + " invocations, " + bytesText(limits.maxComputeSharedMemorySize) + " shared");
  add("timestamps", device.timestampMask ? number(limits.timestampPeriod) + " ns" : "none");
  add("subgroups", std::to_string(info.subgroupSize) + ", from " + subgroupSizes(info) +
                       (device.canSetSubgroupSize ? ", can be required" : ", cannot be required"));
  add("subgroup size required", cluster.need.size ? std::to_string(cluster.need.size) : "none");
  add("particles a cluster", std::to_string(cluster.cluster));
  add("arrays are read through",
      std::string(info.texelReads ? "uniform texel buffers: " : "storage buffers: ") + std::string(info.readsBecause));
  add("passes", device.isCpu ? "separate (CPU)" : "merged (not a CPU)");
  return table;
}

}  // namespace

DeviceDescription describeDevice(const Device& from) {
  const DeviceImpl& device = implOf(from);
  const DeviceInfo& info = device.info;
  const ClusterChoice cluster = chooseCluster(info, device.canSetSubgroupSize, device.vendor, kFluidGroup);
  DeviceDescription description;
  description.name = info.name;
  description.identity = info.name + ", " + info.driver + ", Vulkan " + info.api;
  description.variants = "clusters of " + std::to_string(cluster.cluster) + ", subgroups of " +
                         (cluster.need.size ? std::to_string(cluster.need.size) : subgroupSizes(info)) + ", " +
                         (info.texelReads ? "texel buffers" : "storage buffers");
  description.availableBytes = from.availableBytes();
  description.table = limitsTable(device, description.availableBytes, cluster);
  description.result = {{"case", "device"},
                        {"cluster", cluster.cluster},
                        {"required_subgroup_size", cluster.need.size},
                        {"texel_reads", info.texelReads},
                        {"available_bytes", description.availableBytes}};
  return description;
}

}  // namespace rill::bench
