#pragma once
// What is done with a buffer or an image of a render graph, and what that is to Vulkan.
//
//   const rill::UseState sampled = rill::useState(rill::Use::DrawSampled);
//   VkImageMemoryBarrier2 barrier{};  // of a host that goes on after the graph
//   barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
//   barrier.srcStageMask = sampled.stages;
//   barrier.srcAccessMask = sampled.access;
//   barrier.oldLayout = sampled.layout;
#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "rill/export.hpp"

namespace rill {

/// What a pass does with a resource, and in which stage. useState() says what each is to Vulkan.
enum class Use : uint8_t {
  Nothing,         ///< no access; as an import's `before`: nothing to wait for (an image: no content), as its `after`: left as it is
  ComputeRead,     ///< storage buffer or image, read
  ComputeTexel,    ///< uniform texel buffer, read
  ComputeUniform,  ///< uniform buffer, read
  ComputeSampled,  ///< image, read by texelFetch, or through a sampler of the host's (Commands::image)
  ComputeWrite,    ///< storage buffer or image, read and written
  ComputeAtomic,   ///< storage buffer, atomics of one kind whose result is unused: they commute with each other, no barrier between
  DrawRead,        ///< storage buffer, read by vertex and fragment shaders
  DrawUniform,     ///< uniform buffer, read by vertex and fragment shaders
  DrawSampled,     ///< image, read by vertex and fragment shaders; as ComputeSampled
  VertexInput,     ///< vertex or index buffer of draws that the host records itself (Commands::handle)
  ColorTarget,     ///< image, drawn to
  DepthTarget,     ///< image of a depth format, tested and written by draws
  Indirect,        ///< dispatch or draw arguments
  CopySource,
  CopyTarget,
  HostRead,  ///< read by the host after the frame has completed
  Present,   ///< image of a swapchain, as vkQueuePresentKHR takes it and leaves it; of imports alone
  Unknown    ///< as an import's `before` alone: anything may have happened to it; an image's content is lost
};

/// A state of a resource in Vulkan's words: who touches it, how, and in which layout.
struct UseState {
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;          ///< reads and writes
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< of an image; undefined: no use of images
  VkImageUsageFlags imageUsage = 0;                  ///< what an image must have been created for
  VkBufferUsageFlags bufferUsage = 0;                ///< what a buffer must have been created for
  friend bool operator==(const UseState&, const UseState&) = default;
};

/// What a use is to Vulkan: what a host's own barriers beside a graph name, and what its resources must be created for.
RILL_API UseState useState(Use use);

/// The state of an import before or after a graph: that of a Use, or one of the host's own where no Use says it (a fragment shader that
/// samples in the GENERAL layout, a build of an acceleration structure). A UseState's flags of usage are not looked at here.
struct ImportState {
  ImportState(Use known = Use::Nothing) : use(known) {}
  ImportState(const UseState& ofTheHost) : isOwn(true), own(ofTheHost) {}
  Use use = Use::Nothing;
  bool isOwn = false;
  UseState own = {};
  friend bool operator==(const ImportState&, const ImportState&) = default;
};

}  // namespace rill
