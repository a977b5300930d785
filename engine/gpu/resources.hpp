#pragma once
// Buffers owned by the engine's modules, retired according to the host's frame clock.
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
  Readback  ///< mapped, preferably cached, read by the host
};

/// A buffer with its own memory. The destructor retires the handles; the device frees them once the frame
/// being recorded at that time has completed. Usable as storage, texel, uniform, vertex, index and indirect
/// buffer and for copies.
class Buffer {
 public:
  Buffer() = default;
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  VkBuffer handle() const { return handle_; }
  uint64_t size() const { return size_; }                                        ///< requested bytes
  std::byte* mapped() const { return static_cast<std::byte*>(memory_.mapped); }  ///< null for MemoryKind::Device; host-coherent
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  friend class DeviceImpl;
  DeviceImpl* device_ = nullptr;
  VkBuffer handle_ = VK_NULL_HANDLE;
  MemoryBlock memory_;
  uint64_t size_ = 0;
};

/// `size`: 1 byte to DeviceInfo::maxBufferBytes, otherwise BadInput. The content is undefined. Errors name `name` and the size.
Expected<Buffer> createBuffer(Device& device, std::string_view name, uint64_t size, MemoryKind kind = MemoryKind::Device);

/// The number of cached pipelines, for tests.
size_t pipelineCount(const Device& device);

}  // namespace rill
