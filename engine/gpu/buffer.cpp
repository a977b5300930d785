#include <optional>
#include <utility>

#include "gpu/device_impl.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {
namespace {

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                      VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                      VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

std::optional<uint32_t> findMemoryType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed, VkMemoryPropertyFlags wanted) {
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1u) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  return std::nullopt;
}

}  // namespace

std::optional<uint32_t> DeviceImpl::chooseMemoryType(uint32_t allowed, MemoryKind kind) const {
  constexpr VkMemoryPropertyFlags mapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  if (kind == MemoryKind::Device) {
    if (auto type = findMemoryType(memory, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)) return type;
    return findMemoryType(memory, allowed, 0);
  }
  if (kind == MemoryKind::Readback)  // reading uncached memory is slower by an order of magnitude
    if (auto type = findMemoryType(memory, allowed, mapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT)) return type;
  return findMemoryType(memory, allowed, mapped);
}

Buffer::~Buffer() {
  if (!device_) return;
  device_->retired.add(device_->clock.recording, VK_OBJECT_TYPE_BUFFER, handle_);
  device_->retired.add(device_->clock.recording, VK_OBJECT_TYPE_DEVICE_MEMORY, memory_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)),
      handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, VK_NULL_HANDLE)),
      mapped_(std::exchange(other.mapped_, nullptr)),
      size_(std::exchange(other.size_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  if (this != &other) {
    Buffer taken(std::move(other));
    std::swap(device_, taken.device_);
    std::swap(handle_, taken.handle_);
    std::swap(memory_, taken.memory_);
    std::swap(mapped_, taken.mapped_);
    std::swap(size_, taken.size_);
  }
  return *this;
}

Expected<Buffer> DeviceImpl::createBuffer(std::string_view name, uint64_t size, MemoryKind kind) {
  const std::string quoted = "'" + std::string(name) + "'";
  if (size == 0 || size > info.maxStorageBufferBytes)
    return Error{ErrorKind::BadInput, "buffer " + quoted + " of " + bytesText(size) + ": 1 byte to " +
                                          bytesText(info.maxStorageBufferBytes) + " are possible on " + info.name};
  Buffer buffer;  // what has been made so far is retired by its destructor where a later step fails
  buffer.device_ = this;
  buffer.size_ = size;
  VkBufferCreateInfo create{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  create.size = (size + 15) & ~15ull;  // whole texels, and whole words for vkCmdFillBuffer
  create.usage = kUsage;
  if (VkResult r = vk.CreateBuffer(handle, &create, callbacks, &buffer.handle_); r != VK_SUCCESS)
    return vulkanError(r, "creating buffer " + quoted + " of " + bytesText(size));

  VkMemoryRequirements needs{};
  vk.GetBufferMemoryRequirements(handle, buffer.handle_, &needs);
  const auto type = chooseMemoryType(needs.memoryTypeBits, kind);
  if (!type) return Error{ErrorKind::NoDevice, "device '" + info.name + "' has no memory type for buffer " + quoted};
  VkMemoryDedicatedAllocateInfo dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
  dedicated.buffer = buffer.handle_;
  VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &dedicated, needs.size, *type};
  if (VkResult r = vk.AllocateMemory(handle, &allocate, callbacks, &buffer.memory_); r != VK_SUCCESS)
    return vulkanError(r, "allocating " + bytesText(needs.size) + " for buffer " + quoted);
  if (VkResult r = vk.BindBufferMemory(handle, buffer.handle_, buffer.memory_, 0); r != VK_SUCCESS)
    return vulkanError(r, "binding the memory of buffer " + quoted);
  if (kind != MemoryKind::Device) {
    void* address = nullptr;
    if (VkResult r = vk.MapMemory(handle, buffer.memory_, 0, VK_WHOLE_SIZE, 0, &address); r != VK_SUCCESS)
      return vulkanError(r, "mapping buffer " + quoted);
    buffer.mapped_ = static_cast<std::byte*>(address);
  }
  return buffer;
}

Expected<Buffer> createBuffer(Device& device, std::string_view name, uint64_t size, MemoryKind kind) {
  return device.impl().createBuffer(name, size, kind);
}

}  // namespace rill
