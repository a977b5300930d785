#include "gpu/device_memory.hpp"

#include <optional>

#include "gpu/device_impl.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {
namespace {

struct Properties {
  VkMemoryPropertyFlags required, preferred;
};

Properties propertiesOf(MemoryKind kind) {
  constexpr VkMemoryPropertyFlags mapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (kind) {
    case MemoryKind::Device:
      return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryKind::Upload:
      return {mapped, 0};
    case MemoryKind::Readback:
      return {mapped, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};  // uncached reads are ten times slower
  }
  return {0, 0};
}

std::optional<uint32_t> findType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t allowed, VkMemoryPropertyFlags wanted) {
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1u) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  return std::nullopt;
}

std::optional<uint32_t> chooseType(const DeviceImpl& device, uint32_t allowed, MemoryKind kind) {
  const auto [required, preferred] = propertiesOf(kind);
  if (const auto type = findType(device.memory, allowed, required | preferred)) return type;
  return findType(device.memory, allowed, required);
}

Expected<MemoryBlock> allocateFromDevice(DeviceImpl& device, const VkMemoryRequirements& needs, MemoryKind kind, const MemoryOwner& owner,
                                         uint32_t type) {
  MemoryBlock block;
  block.memoryType = type;
  VkMemoryDedicatedAllocateInfo dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO};
  dedicated.buffer = owner.buffer;
  const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, owner.buffer ? &dedicated : nullptr, needs.size, type};
  if (VkResult r = device.vk.AllocateMemory(device.handle, &info, device.callbacks, &block.memory); r != VK_SUCCESS) {
    Error error = vulkanError(r, "allocating " + bytesText(needs.size) + " for " + owner.description());
    if (r == VK_ERROR_OUT_OF_DEVICE_MEMORY && device.hasMemoryBudget)
      error.message += "; " + device.info.name + " has " + bytesText(device.device->availableBytes()) + " left for this process";
    return error;
  }
  if (kind == MemoryKind::Device) return block;
  if (VkResult r = device.vk.MapMemory(device.handle, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped); r != VK_SUCCESS) {
    freeMemory(device, block);
    return vulkanError(r, "mapping " + owner.description());
  }
  return block;
}

/// Why a block returned by the host is invalid; empty if it is valid.
std::string blockError(const DeviceImpl& device, const MemoryBlock& block, const MemoryRequest& request) {
  const VkMemoryRequirements& needs = request.requirements;
  if (!block.memory) return "no VkDeviceMemory";
  if (block.offset % needs.alignment != 0)
    return "offset " + std::to_string(block.offset) + ", not a multiple of " + std::to_string(needs.alignment);
  if (block.memoryType >= device.memory.memoryTypeCount || !(needs.memoryTypeBits >> block.memoryType & 1u))
    return "memory type " + std::to_string(block.memoryType) + ", not an allowed type";
  if ((device.memory.memoryTypes[block.memoryType].propertyFlags & request.required) != request.required)
    return "memory type " + std::to_string(block.memoryType) + ", which is not host visible and coherent";
  if (request.mapped && !block.mapped) return "no mapped address";
  return {};
}

Expected<MemoryBlock> allocateFromHost(DeviceImpl& device, const VkMemoryRequirements& needs, MemoryKind kind, const MemoryOwner& owner) {
  const auto [required, preferred] = propertiesOf(kind);
  const MemoryRequest request{needs, required, preferred, kind != MemoryKind::Device, !owner.buffer, owner.name.c_str()};
  MemoryBlock block;
  const std::string action = "allocating " + bytesText(needs.size) + " for " + owner.description();
  if (VkResult r = device.hooks->allocate(device.hooks->user, &request, &block); r != VK_SUCCESS)
    return vulkanError(r, action + " with the host's MemoryHooks");
  if (const std::string error = blockError(device, block, request); !error.empty()) {
    freeMemory(device, block);
    return Error{ErrorKind::BadInput, action + ": the host's MemoryHooks::allocate returned " + error};
  }
  if (!request.mapped) block.mapped = nullptr;  // hosts may keep all memory mapped
  return block;
}

}  // namespace

Expected<MemoryBlock> allocateMemory(DeviceImpl& device, const VkMemoryRequirements& needs, MemoryKind kind, const MemoryOwner& owner) {
  const auto type = chooseType(device, needs.memoryTypeBits, kind);
  if (!type) return Error{ErrorKind::NoDevice, "device '" + device.info.name + "' has no memory type for " + owner.description()};
  return device.hooks ? allocateFromHost(device, needs, kind, owner) : allocateFromDevice(device, needs, kind, owner, *type);
}

void freeMemory(const DeviceImpl& device, const MemoryBlock& block) {
  if (device.hooks)
    device.hooks->free(device.hooks->user, &block);
  else
    device.vk.FreeMemory(device.handle, block.memory, device.callbacks);
}

}  // namespace rill
