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

const UseRow& useRow(Use use);
inline bool writes(Use use) { return useRow(use).write != 0; }
inline uint32_t useBit(Use use) { return 1u << uint32_t(use); }

}  // namespace rill
