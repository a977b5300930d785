#pragma once
// How a host hands out device memory from its own allocator (VMA, say), in place of vkAllocateMemory.
//
//   rill::MemoryHooks hooks;  // for HostDevice::memory; memory that Rill maps is left out here
//   hooks.allocate = [](void*, const rill::MemoryRequest* request, rill::MemoryBlock* block) {
//     while (!(request->requirements.memoryTypeBits >> block->memoryType & 1)) ++block->memoryType;
//     const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, request->requirements.size, block->memoryType};
//     return vkAllocateMemory(vkDevice, &info, nullptr, &block->memory);
//   };
//   hooks.free = [](void*, const rill::MemoryBlock* block) { vkFreeMemory(vkDevice, block->memory, nullptr); };
#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace rill {

/// What a block of device memory is wanted for.
struct MemoryRequest {
  VkMemoryRequirements requirements{};  ///< size (bytes), alignment, memory types that will do
  VkMemoryPropertyFlags required = 0;   ///< host visible and coherent for a block that Rill maps, 0 for one that it does not
  VkMemoryPropertyFlags preferred = 0;  ///< device local; of a block that the host reads: cached
  bool mapped = false;                  ///< MemoryBlock::mapped is needed
  bool images = false;                  ///< images of optimal tiling will lie in it, one over the other; else one buffer. Keep the two
                                        ///< bufferImageGranularity apart
  const char* name = "";                ///< for the host's statistics; valid during the call
};

/// A piece of the host's memory, Rill's alone until it is freed.
struct MemoryBlock {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;  ///< bytes; a multiple of the alignment that was asked for
  uint32_t memoryType = 0;  ///< of `memory`: one of those that will do
  void* mapped = nullptr;   ///< address of the block's first byte, where it was asked for; mapped until the block is freed
  void* handle = nullptr;   ///< the host's own; Rill hands it back
};

/// Both functions are called by the thread that calls Rill. What they are given is valid during the call.
struct MemoryHooks {
  void* user = nullptr;
  /// VK_SUCCESS with a block, or what Rill's caller gets as an Error. Called inside calls that return an Expected, and by no others.
  VkResult (*allocate)(void* user, const MemoryRequest* request, MemoryBlock* block) = nullptr;
  /// Once for each block: in Device::beginFrame, when the frames that used it have completed, or in ~Device. In the call that allocated it
  /// where Rill cannot use it.
  void (*free)(void* user, const MemoryBlock* block) = nullptr;
};

}  // namespace rill
