#pragma once
// What is behind rill::Device: the function tables, limits, the store of pipelines and what waits to be destroyed.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/function_table.hpp"
#include "gpu/pipeline.hpp"
#include "gpu/resources.hpp"
#include "gpu/shader_library.hpp"
#include "rill/memory.hpp"

namespace rill {

/// Largest buffer that Rill makes: lavapipe's maxStorageBufferRange, and so the least that has been tried.
inline constexpr uint64_t kMaxBufferBytes = 128ull * 1024 * 1024;

/// Handles and memory whose last use was recorded in some frame, destroyed once the host says that the frame has completed.
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

  InstanceTable instance;
  DeviceTable vk;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice handle = VK_NULL_HANDLE;
  VkPipelineCache cache = VK_NULL_HANDLE;
  const VkAllocationCallbacks* callbacks = nullptr;
  std::optional<MemoryHooks> hooks;  ///< none: memory is allocated from the device itself
  DeviceInfo info;
  VkPhysicalDeviceLimits limits{};
  VkPhysicalDeviceMemoryProperties memory{};
  uint64_t timestampMask = 0;   ///< valid bits of the queue's timestamps; 0: it has none
  bool hasGraphics = false;           ///< the host's queue has graphics
  bool sizedSubgroups = false;  ///< a compute stage can be given a subgroup size
  FrameClock clock;
  RetireQueue retired;
  ShaderLibrary shaders;
  PipelineStore pipelines;
  MessageCallback message;
  std::unique_ptr<ShaderReload> reload;

 private:
  std::array<uint64_t, 64> abandoned_{};  ///< the latest ones; older ones have long been looked at
  size_t abandonedCount_ = 0;
};

}  // namespace rill
