#pragma once
// Blocks of device memory, from the host's hooks where it has lent some, else an allocation each.
#include <string>

#include "gpu/resources.hpp"
#include "rill/memory.hpp"

namespace rill {

class DeviceImpl;

/// Whom a block is for.
struct MemoryUser {
  std::string name;                  ///< of the buffer, or of the images together
  VkBuffer buffer = VK_NULL_HANDLE;  ///< the only one that will lie in it; null: images
  std::string said() const { return buffer ? "buffer '" + name + "'" : name; }
};

/// Mapped unless `kind` is Device. NoDevice where no memory type will do, OutOfMemory; BadInput for a block of the host's that is not what
/// was asked for. All name the user.
Expected<MemoryBlock> allocateMemory(DeviceImpl& device, const VkMemoryRequirements& requirements, MemoryKind kind, const MemoryUser& user);

/// At once. What lies in it has been destroyed.
void freeMemory(const DeviceImpl& device, const MemoryBlock& block);

}  // namespace rill
