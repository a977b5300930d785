#include <utility>

#include "gpu/device_impl.hpp"
#include "gpu/device_memory.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {
namespace {

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                      VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                      VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

}  // namespace

Buffer::~Buffer() {
  if (!device_) return;
  device_->retired.add(device_->clock.recording, VK_OBJECT_TYPE_BUFFER, handle_);
  device_->retired.add(device_->clock.recording, memory_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)),
      handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, {})),
      size_(std::exchange(other.size_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  if (this != &other) {
    Buffer taken(std::move(other));
    std::swap(device_, taken.device_);
    std::swap(handle_, taken.handle_);
    std::swap(memory_, taken.memory_);
    std::swap(size_, taken.size_);
  }
  return *this;
}

Expected<Buffer> DeviceImpl::createBuffer(std::string_view name, uint64_t size, MemoryKind kind) {
  const std::string quoted = "'" + std::string(name) + "'";
  if (size == 0 || size > info.maxBufferBytes)
    return Error{ErrorKind::BadInput, "buffer " + quoted + " of " + bytesText(size) + "; " + info.name + " supports 1 byte to " +
                                          bytesText(info.maxBufferBytes) + " (" + std::string(info.maxBufferName) + ")"};
  Buffer buffer;  // its destructor retires the handles if a later step fails
  buffer.device_ = this;
  buffer.size_ = size;
  VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  create.size = (size + 15) & ~15ull;  // multiple of a texel, and of a word for vkCmdFillBuffer
  create.usage = kUsage;
  if (VkResult r = vk.CreateBuffer(handle, &create, callbacks, &buffer.handle_); r != VK_SUCCESS)
    return vulkanError(r, "creating buffer " + quoted + " of " + bytesText(size));

  VkMemoryRequirements needs{};
  vk.GetBufferMemoryRequirements(handle, buffer.handle_, &needs);
  auto block = allocateMemory(*this, needs, kind, {std::string(name), buffer.handle_});
  if (!block) return block.error();
  buffer.memory_ = *block;
  if (VkResult r = vk.BindBufferMemory(handle, buffer.handle_, block->memory, block->offset); r != VK_SUCCESS)
    return vulkanError(r, "binding the memory of buffer " + quoted);
  return buffer;
}

Expected<Buffer> createBuffer(Device& device, std::string_view name, uint64_t size, MemoryKind kind) {
  return implOf(device).createBuffer(name, size, kind);
}

}  // namespace rill
