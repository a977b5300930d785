#pragma once
// Uses of buffers and images in a render graph, and the Vulkan stages, accesses, layouts and usage flags of each.
//
//   const rill::UseState sampled = rill::useState(rill::Use::DrawSampled);
//   VkImageMemoryBarrier2 barrier{};  // recorded by the host after the graph
//   barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
//   barrier.srcStageMask = sampled.stages;
//   barrier.srcAccessMask = sampled.access;
//   barrier.oldLayout = sampled.layout;
#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "rill/export.hpp"

namespace rill {

/// How a pass accesses a resource, and in which stage. useState() returns the Vulkan state of each.
enum class Use : uint8_t {
  Nothing,         ///< no access. Import `before`: nothing to wait for (image: no content); `after`: no transition
  ComputeRead,     ///< storage buffer or image, read
  ComputeTexel,    ///< uniform texel buffer, read
  ComputeUniform,  ///< uniform buffer, read
  ComputeSampled,  ///< image, read by texelFetch, or through a sampler of the host (Commands::image)
  ComputeWrite,    ///< storage buffer or image, read and written
  ComputeAtomic,   ///< storage buffer, commutative atomics whose results are unused: no barrier between two such passes
  DrawRead,        ///< storage buffer, read by vertex and fragment shaders
  DrawTexel,       ///< uniform texel buffer, read by vertex and fragment shaders
  DrawUniform,     ///< uniform buffer, read by vertex and fragment shaders
  DrawSampled,     ///< image, read by vertex and fragment shaders; as ComputeSampled
  VertexInput,     ///< vertex or index buffer of draws recorded by the host (Commands::handle)
  ColorTarget,     ///< image, color attachment
  DepthTarget,     ///< image of a depth format, tested and written by draws
  Indirect,        ///< dispatch or draw arguments
  CopySource,
  CopyTarget,
  HostRead,  ///< read by the host after the frame has completed
  Present,   ///< swapchain image before and after vkQueuePresentKHR; imports only
  Unknown    ///< import `before` only: any earlier access; the content of an image is lost
};

/// The Vulkan state of a resource: stages, accesses and layout.
struct UseState {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;          ///< reads and writes
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< undefined: not a use of images
  VkImageUsageFlags imageUsage = 0;                  ///< usage flags that an image must have been created with
  VkBufferUsageFlags bufferUsage = 0;                ///< usage flags that a buffer must have been created with
  friend bool operator==(const UseState&, const UseState&) = default;
};

/// The Vulkan state of `use`, for the host's own barriers and for creating its resources.
RILL_API UseState useState(Use use);

/// The state of an import before or after a graph: a Use, or a custom state that no Use describes (a
/// fragment shader that samples in the GENERAL layout, an acceleration structure build). The usage flags of
/// a custom UseState are ignored.
struct ImportState {
  ImportState(Use known = Use::Nothing) : use(known) {}
  ImportState(const UseState& state) : isCustom(true), custom(state) {}
  Use use = Use::Nothing;
  bool isCustom = false;
  UseState custom = {};
  friend bool operator==(const ImportState&, const ImportState&) = default;
};

}  // namespace rill
