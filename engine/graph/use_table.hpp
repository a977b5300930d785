#pragma once
// The table of stages, accesses, layouts and usage flags of each Use.
#include <cstddef>

#include "rill/use.hpp"

namespace rill {

struct UseRow {
  Use use;  ///< Nothing for a custom state
  const char* name;
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 read;
  VkAccessFlags2 write;
  VkImageLayout layout;            ///< VK_IMAGE_LAYOUT_UNDEFINED: not a use of images
  VkImageUsageFlags usage;         ///< required usage flags of an image
  VkBufferUsageFlags bufferUsage;  ///< required usage flags of a buffer
};

inline constexpr size_t kUseCount = size_t(Use::Unknown) + 1;
/// Whether a value given by the host is a valid Use.
constexpr bool isUse(Use use) { return size_t(use) < kUseCount; }

const UseRow& useRow(Use use);
UseRow useRow(const ImportState& state);
inline bool writes(Use use) { return useRow(use).write != 0; }
inline bool isTarget(Use use) { return use == Use::ColorTarget || use == Use::DepthTarget; }
/// Uses that need a graphics queue.
inline bool isGraphicsUse(Use use) {
  return use == Use::DrawRead || use == Use::DrawUniform || use == Use::DrawSampled || use == Use::VertexInput || isTarget(use);
}
/// Uses that are valid for images only.
inline bool isImageOnly(Use use) { return use == Use::ComputeSampled || use == Use::DrawSampled || use == Use::Present || isTarget(use); }
/// Uses that are valid only as states of imports, not in passes.
inline bool isImportOnly(Use use) { return use == Use::Nothing || use == Use::HostRead || use == Use::Present || use == Use::Unknown; }
inline uint32_t useBit(Use use) { return use == Use::Nothing ? 0 : 1u << uint32_t(use); }

}  // namespace rill
