#pragma once
// A Vulkan device that only records calls, to test prepare() and record() without a driver and its allocations.
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rill/device.hpp"

namespace rill::test {

struct NullCommand {
  enum Kind : uint8_t {
    Barrier,
    BindPipeline,
    BindSet,
    Dispatch,
    DispatchIndirect,
    Copy,
    CopyToImage,
    CopyFromImage,
    CopyImage,
    ClearImage,
    Update,
    BeginRendering,  // colors, load and store of the first target, whether there is depth
    EndRendering,
    Draw,
    DrawIndirect,
    Fill,
    ResetQueries,
    Timestamp
  } kind;
  VkMemoryBarrier2 barrier;  ///< of Barrier
  uint64_t handle;           ///< pipeline, set, target buffer or image
  uint64_t a, b, c;  ///< groups; source offset, target offset, bytes; layout, width, height; of Barrier: image barriers in a, memory
                     ///< barriers in handle
};

/// What the device says of itself.
struct NullProperties {
  const char* name = "null device";
  uint32_t vendor = 0;  ///< PCI id
  uint32_t subgroupSize = 8, minSubgroupSize = 8, maxSubgroupSize = 8;
  bool requiresSubgroupSize = true;  ///< a size can be required in compute shaders
  uint32_t maxTexelBufferElements = 65536;
  VkSubgroupFeatureFlags subgroupOperations = 0xff;
  uint32_t api = VK_API_VERSION_1_3;
  uint32_t storageBuffers = 64;         ///< that a shader can bind
  uint32_t workgroupInvocations = 256;  ///< at most, and in each dimension
  bool texelBuffers = true;             ///< of each format
  uint32_t storageBufferRange = 1u << 30;
  uint64_t maxBufferSize = uint64_t{1} << 40, maxAllocation = uint64_t{1} << 40;
  uint64_t heapBytes = uint64_t{1} << 32;
  std::optional<uint64_t> availableBytes = {};  ///< as VK_EXT_memory_budget reports; empty: no such extension
  std::vector<VkBool32 VkPhysicalDeviceVulkan13Features::*> missingFeatures = {};
};

/// What a VkPipelineCache holds: keys of pipelines.
using NullCache = std::set<std::string>;

/// A compute pipeline that was created.
struct NullPipeline {
  uint32_t requiredSubgroupSize;  ///< 0: any
  bool fullSubgroups;
  std::vector<uint32_t> constants;  ///< specialized, by their ids from 0
  std::vector<uint32_t> words;      ///< SPIR-V
};

class NullVulkan {
 public:
  NullVulkan();
  ~NullVulkan();
  NullVulkan(const NullVulkan&) = delete;
  NullVulkan& operator=(const NullVulkan&) = delete;

  /// `features`: a chain of further structures, as enabled
  HostDevice host(void* features = nullptr);
  static VkCommandBuffer commandBuffer() { return reinterpret_cast<VkCommandBuffer>(uintptr_t(1)); }
  size_t count(NullCommand::Kind kind) const;

  NullProperties properties;  ///< read when the device is borrowed
  std::vector<NullCommand> commands;
  std::vector<NullPipeline> pipelines;
  NullCache* cache = nullptr;                        ///< that of the host, if it has one
  size_t pipelinesCompiled = 0;                      ///< graphics too, without those that the cache had
  std::vector<VkImageMemoryBarrier2> imageBarriers;  ///< of all barriers, in order
  VkResult allocationResult = VK_SUCCESS;            ///< returned by vkAllocateMemory
  uint64_t bufferBytes = 0;                          ///< of all buffers that were created
  int64_t liveObjects = 0;                           ///< created and not yet destroyed
  size_t setsAllocated = 0, viewsCreated = 0, buffersCreated = 0, imagesCreated = 0;

 private:
  VkPhysicalDeviceVulkan13Features vulkan13_{};
  VkPhysicalDeviceFeatures2 features_{};
};

}  // namespace rill::test
