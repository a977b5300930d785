#pragma once
// The one place that says which stage, access and layout a Use is.
#include "rill/graph.hpp"

namespace rill {

struct UseRow {
  Use use;
  const char* name;
  VkPipelineStageFlags2 stage;
  VkAccessFlags2 read;
  VkAccessFlags2 write;
  VkImageLayout layout;     ///< VK_IMAGE_LAYOUT_UNDEFINED: no use of an image
  VkImageUsageFlags usage;  ///< what an image must have been made for
};

inline constexpr size_t kUseCount = size_t(Use::Unknown) + 1;
/// Whether a host's value is one of them.
constexpr bool isUse(Use use) { return size_t(use) < kUseCount; }

const UseRow& useRow(Use use);
inline bool writes(Use use) { return useRow(use).write != 0; }
inline bool isTarget(Use use) { return use == Use::ColourTarget || use == Use::DepthTarget; }
/// Uses that need a queue with graphics.
inline bool isDrawing(Use use) { return use == Use::DrawRead || use == Use::DrawUniform || use == Use::DrawSampled || isTarget(use); }
/// What only an image can be used as.
inline bool needsImage(Use use) { return use == Use::ComputeSampled || use == Use::DrawSampled || isTarget(use); }
inline uint32_t useBit(Use use) { return 1u << uint32_t(use); }

}  // namespace rill
