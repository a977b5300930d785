#pragma once
// The one place that says which stage, access, layout and usage a Use is.
#include <cstddef>

#include "rill/use.hpp"

namespace rill {

struct UseRow {
  Use use;  ///< None: a state of the host's own
  const char* name;
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 read;
  VkAccessFlags2 write;
  VkImageLayout layout;            ///< VK_IMAGE_LAYOUT_UNDEFINED: no use of an image
  VkImageUsageFlags usage;         ///< what an image must have been made for
  VkBufferUsageFlags bufferUsage;  ///< what a buffer must have been made for
};

inline constexpr size_t kUseCount = size_t(Use::Unknown) + 1;
/// Whether a host's value is one of them.
constexpr bool isUse(Use use) { return size_t(use) < kUseCount; }

const UseRow& useRow(Use use);
UseRow useRow(const ImportState& state);
inline bool writes(Use use) { return useRow(use).write != 0; }
inline bool isTarget(Use use) { return use == Use::ColorTarget || use == Use::DepthTarget; }
/// Uses that need a queue with graphics.
inline bool isDrawing(Use use) {
  return use == Use::DrawRead || use == Use::DrawUniform || use == Use::DrawSampled || use == Use::VertexInput || isTarget(use);
}
/// What only an image can be used as.
inline bool needsImage(Use use) { return use == Use::ComputeSampled || use == Use::DrawSampled || use == Use::Present || isTarget(use); }
/// States of imports, which are nothing that a pass does.
inline bool outsideOnly(Use use) { return use == Use::Nothing || use == Use::HostRead || use == Use::Present || use == Use::Unknown; }
inline uint32_t useBit(Use use) { return use == Use::Nothing ? 0 : 1u << uint32_t(use); }

}  // namespace rill
