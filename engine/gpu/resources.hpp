#pragma once
// Device memory, owned by the engine's modules and retired by the host's frame clock.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rill/memory.hpp"
#include "rill/pipeline.hpp"

namespace rill {

enum class MemoryKind : uint8_t {
  Device,   ///< device-local
  Upload,   ///< mapped, written by the host
  Readback  ///< mapped, cached where there is such memory, read by the host
};

/// A buffer with memory of its own. Moving is cheap; the destructor hands the handles to the device, which frees them
/// when the frame that was recording then has completed. Usable as storage, texel, uniform, indirect and copy source or target.
class Buffer {
 public:
  Buffer() = default;
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  VkBuffer handle() const { return handle_; }
  uint64_t size() const { return size_; }                                        ///< bytes asked for
  std::byte* mapped() const { return static_cast<std::byte*>(memory_.mapped); }  ///< null for MemoryKind::Device; host-coherent
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  friend class DeviceImpl;
  DeviceImpl* device_ = nullptr;
  VkBuffer handle_ = VK_NULL_HANDLE;
  MemoryBlock memory_;
  uint64_t size_ = 0;
};

/// `size` bytes (1 .. 128 MiB; larger or 0 is BadInput), content undefined. OutOfMemory names `name` and the size.
Expected<Buffer> createBuffer(Device& device, std::string_view name, uint64_t size, MemoryKind kind = MemoryKind::Device);

/// How many pipelines the device holds (a test bounds it).
size_t pipelineCount(const Device& device);

}  // namespace rill
