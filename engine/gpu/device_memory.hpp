#pragma once
// Allocation of device memory, through the host's hooks if set, otherwise one vkAllocateMemory per block.
#include <string>

#include "gpu/resources.hpp"
#include "rill/memory.hpp"

namespace rill {

class DeviceImpl;

/// What a block is used for.
struct MemoryOwner {
  std::string name;                  ///< of the buffer or the group of images
  VkBuffer buffer = VK_NULL_HANDLE;  ///< the one buffer bound to the block; null: images
  std::string description() const { return buffer ? "buffer '" + name + "'" : name; }
};

/// Mapped unless `kind` is Device. Fails with NoDevice if no memory type is suitable, with OutOfMemory, and
/// with BadInput if the host's hooks return an invalid block. Messages name the owner.
Expected<MemoryBlock> allocateMemory(DeviceImpl& device, const VkMemoryRequirements& requirements, MemoryKind kind,
                                     const MemoryOwner& owner);

/// Frees immediately. Objects bound to the block must already be destroyed.
void freeMemory(const DeviceImpl& device, const MemoryBlock& block);

}  // namespace rill
