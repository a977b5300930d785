#pragma once
// Hooks to allocate device memory from the host's allocator (VMA, for example) instead of vkAllocateMemory.
//
//   rill::MemoryHooks hooks;  // for HostDevice::memory; this example does not handle mapped memory
//   hooks.allocate = [](void*, const rill::MemoryRequest* request, rill::MemoryBlock* block) {
//     while (!(request->requirements.memoryTypeBits >> block->memoryType & 1)) ++block->memoryType;
//     const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, request->requirements.size, block->memoryType};
//     return vkAllocateMemory(vkDevice, &info, nullptr, &block->memory);
//   };
//   hooks.free = [](void*, const rill::MemoryBlock* block) { vkFreeMemory(vkDevice, block->memory, nullptr); };
#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace rill {

/// Parameters of an allocation.
struct MemoryRequest {
  VkMemoryRequirements requirements{};  ///< size (bytes), alignment, allowed memory types
  VkMemoryPropertyFlags required = 0;   ///< host visible and coherent if Rill maps the block, otherwise 0
  VkMemoryPropertyFlags preferred = 0;  ///< device local; host cached for read-back memory
  bool mapped = false;                  ///< whether MemoryBlock::mapped must be set
  bool images = false;                  ///< true: aliased images with optimal tiling; false: one buffer. Respect bufferImageGranularity
                                        ///< between the two kinds
  const char* name = "";                ///< for the host's statistics; valid during the call
};

/// A range of the host's memory, for Rill's exclusive use until it is freed.
struct MemoryBlock {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  ///< bytes; a multiple of the requested alignment
  uint32_t memoryType = 0;  ///< memory type index of `memory`; one of the allowed types
  void* mapped = nullptr;   ///< host address of the block's first byte if requested; must stay mapped until the block is freed
  void* handle = nullptr;   ///< for the host; passed back unchanged to free()
};

/// Both functions are called by the thread that calls Rill. Pointer arguments are valid during the call.
struct MemoryHooks {
  void* user = nullptr;
  /// Returns VK_SUCCESS and a block, or an error that Rill's caller receives as an Error. Called only inside
  /// calls that return an Expected.
  VkResult (*allocate)(void* user, const MemoryRequest* request, MemoryBlock* block) = nullptr;
  /// Called once per block: in Device::beginFrame once the frames that used it have completed, in ~Device,
  /// or in the allocating call if Rill cannot use the block.
  void (*free)(void* user, const MemoryBlock* block) = nullptr;
};

}  // namespace rill
