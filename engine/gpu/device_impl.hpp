#pragma once
// Implementation of rill::Device: function tables, limits, pipeline cache and the retire queue.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/impl_of.hpp"
#include "gpu/function_table.hpp"
#include "gpu/pipeline.hpp"
#include "gpu/reconvergence.hpp"
#include "gpu/resources.hpp"
#include "gpu/shader_library.hpp"
#include "rill/memory.hpp"

namespace rill {

/// Bytes that no device has in a buffer: the ranges that shaders see are 32-bit numbers. What a device has is DeviceInfo::maxBufferBytes.
inline constexpr uint64_t kMaxBufferBytes = uint64_t{1} << 32;

/// Buffers that hold several things are as large, unless one thing is larger. Every device has buffers of this size.
inline constexpr uint64_t kSharedBufferBytes = uint64_t{128} << 20;

/// Handles and memory, destroyed once the frame that last used them has completed.
class RetireQueue {
 public:
  template <class Handle>
  void add(uint64_t frame, VkObjectType type, Handle handle) {
    if (handle != VK_NULL_HANDLE) entries_.push_back({frame, type, reinterpret_cast<uint64_t>(handle)});
  }
  void add(uint64_t frame, const MemoryBlock& block) {
    if (block.memory != VK_NULL_HANDLE) blocks_.push_back({frame, block});
  }
  void collect(DeviceImpl& device, uint64_t completed);
  size_t size() const { return entries_.size() + blocks_.size(); }

 private:
  struct Entry {
    uint64_t frame;
    VkObjectType type;
    uint64_t handle;
  };
  struct Block {
    uint64_t frame;
    MemoryBlock block;
  };
  std::vector<Entry> entries_;
  std::vector<Block> blocks_;
};

class ShaderReload;

class DeviceImpl {
 public:
  DeviceImpl();
  ~DeviceImpl();
  DeviceImpl(const DeviceImpl&) = delete;
  DeviceImpl& operator=(const DeviceImpl&) = delete;

  Expected<Buffer> createBuffer(std::string_view name, uint64_t size, MemoryKind kind);
  bool abandoned(uint64_t frame) const;
  void abandon(uint64_t frame);

  Device* device = nullptr;  ///< the handle; it changes when the handle is moved
  InstanceTable instance;
  DeviceTable vk;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice handle = VK_NULL_HANDLE;
  VkPipelineCache cache = VK_NULL_HANDLE;
  const VkAllocationCallbacks* callbacks = nullptr;
  std::optional<MemoryHooks> hooks;  ///< empty: memory comes from vkAllocateMemory
  DeviceInfo info;
  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceMemoryProperties memory{};
  uint64_t timestampMask = 0;          ///< valid bits of the queue's timestamps; 0: not supported
  bool hasGraphics = false;            ///< the host's queue has graphics
  uint32_t vendor = 0;                 ///< PCI id
  bool isCpu = false;                  ///< a software driver
  bool canSetSubgroupSize = false;     ///< compute pipelines can require a subgroup size
  uint32_t maxWorkgroupSubgroups = 0;  ///< where a size is required
  Reconvergence reconvergence = Reconvergence::Workgroup;
  bool hasMemoryBudget = false;  ///< VK_EXT_memory_budget
  FrameClock clock;
  RetireQueue retired;
  ShaderLibrary shaders;
  PipelineStore pipelines;
  MessageCallback message;
  std::unique_ptr<ShaderReload> reload;

 private:
  std::array<uint64_t, 64> abandoned_{};  ///< ring of the most recent ones; older frames are no longer queried
  size_t abandonedCount_ = 0;
};

}  // namespace rill
