#pragma once
// Resources of a render graph: transient and imported buffers and images.
//
//   const rill::ImageDesc half{VK_FORMAT_R16G16B16A16_SFLOAT, width / 2, height / 2};
//   const rill::ImageRef transient = graph.create("half", half);
//   const rill::ImageRef imported = graph.import("color", {.handle = colorImage,
//                                                           .desc = {VK_FORMAT_R8G8B8A8_SRGB, width, height},
//                                                           .before = rill::Use::ColorTarget,
//                                                           .after = rill::Use::Present});
#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "rill/use.hpp"

namespace rill {

/// One version of a resource in one frame's graph. compile() reports the use of a ref of an earlier frame,
/// or of a version that a later write consumed, as an error that names pass and resource.
struct ResourceRef {
  uint32_t index = UINT32_MAX;
  uint32_t version = 0;
  uint32_t epoch = 0;
  friend bool operator==(const ResourceRef&, const ResourceRef&) = default;
};
struct BufferRef : ResourceRef {};
struct ImageRef : ResourceRef {};

/// A buffer of the graph.
struct BufferDesc {
  uint64_t size = 0;  ///< bytes, 1 .. DeviceInfo::maxBufferBytes of the device that prepares the graph
};

/// A buffer that outlives the frame. The graph synchronizes it with earlier and later work on the same
/// queue, in this submission or another: the graph waits for `before`, and its writes are visible to
/// `after`. The host adds no barrier. Work on another queue needs a semaphore (and an ownership transfer in
/// EXCLUSIVE sharing mode); `before` is then a UseState with the stages that wait for the semaphore.
///
/// Use::Nothing is right for data that the CPU wrote before the submission. The default, Use::Unknown,
/// waits for everything and is always correct, but discards the content of an image.
/// The buffer must have been created with useState(use).bufferUsage of each of its uses, including `after`.
struct BufferImport {
  VkBuffer handle = VK_NULL_HANDLE;
  uint64_t offset = 0;                ///< bytes; a multiple of the device's storage, uniform and texel offset alignments
  uint64_t size = 0;                  ///< bytes, likewise
  ImportState before = Use::Unknown;  ///< its last use before this graph
  ImportState after = Use::Nothing;   ///< its first use after this graph; synchronized even if every pass is culled
};

/// A 2D image with one layer, one sample per texel and one plane. The graph tracks each mip level as a
/// resource of its own: a pass may read one level while it writes the next (Graph::level).
struct ImageDesc {
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 0, height = 0;  ///< texels of level 0
  uint32_t levels = 1;             ///< mip levels, 1 .. floor(log2(max(width, height))) + 1
  friend bool operator==(const ImageDesc&, const ImageDesc&) = default;
};

/// What happens to an image's old content when a pass writes it.
enum class Load : uint8_t {
  Keep,    ///< preserved
  Clear,   ///< targets only: replaced by the clear value before the first draw
  Discard  ///< undefined; the pass must write all that is read later
};

/// As BufferImport. The graph transitions the image from the layout of `before` to those of its passes and
/// finally to that of `after`. Import a swapchain image with `before` Unknown (or Present to keep its
/// content) and `after` Present. The submission waits for the acquire semaphore at ALL_COMMANDS, or at the
/// first stage that uses the image, and signals the semaphore that vkQueuePresentKHR waits for.
///
/// The image must be 2D with one layer and one sample, and match `desc`; Rill cannot check this. Resolve or
/// copy multisampled and layered images in a pass of the host instead.
struct ImageImport {
  VkImage handle = VK_NULL_HANDLE;
  ImageDesc desc = {};
  ImportState before = Use::Unknown;  ///< its last use before this graph; determines the current layout
  ImportState after = Use::Nothing;   ///< its first use after this graph; determines the final layout, even if every pass is culled
  VkImageUsageFlags usage = 0;        ///< usage flags at creation; if not 0, compile() rejects uses that they do not allow
};

/// Vulkan handles of an image within a pass.
struct ImageHandle {
  VkImage image = VK_NULL_HANDLE;
  /// View of this level only; of a depth format, of its depth aspect. Null if the frame only copies the image.
  VkImageView view = VK_NULL_HANDLE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< layout during this pass, given by the declared use
  uint32_t level = 0;
};

}  // namespace rill
