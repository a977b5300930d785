#pragma once
// What passes of a render graph work on: buffers and images, the graph's own and a host's.
//
//   const rill::ImageDesc half{VK_FORMAT_R16G16B16A16_SFLOAT, width / 2, height / 2};
//   const rill::ImageRef own = graph.create("half", half);
//   const rill::ImageRef lent = graph.import("color", {.handle = colorImage,
//                                                       .desc = {VK_FORMAT_R8G8B8A8_SRGB, width, height},
//                                                       .before = rill::Use::ColorTarget,
//                                                       .after = rill::Use::Present});
#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "rill/use.hpp"

namespace rill {

/// One version of a resource in one frame's graph. Using last frame's, or a version that a later write consumed, is an error
/// that compile() reports with the pass and the resource.
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
  uint64_t size = 0;  ///< bytes, 1 .. 128 MiB
};

/// Memory that outlives the frame: the host's, or what an earlier graph has left. The graph's barriers join it to what lies before and
/// behind on the same queue, in this submission or in another: it waits for `before`, and `after` sees what it has written. The host adds
/// no barrier of its own. Work of another queue needs its semaphore (and, in EXCLUSIVE sharing mode, the host's transfer of ownership);
/// `before` is then a UseState of the stages at which this submission waits for it. What the host's CPU wrote before the submission needs
/// nothing: Use::Nothing. An import starts as Unknown, which waits for everything and is always right, but loses an image's content. The
/// graph never asks what a handle was created for: useState(use).bufferUsage of each use that is made of it, `after` included.
struct BufferImport {
  VkBuffer handle = VK_NULL_HANDLE;
  uint64_t offset = 0;                ///< a multiple of the device's alignments of storage, uniform and texel offsets
  uint64_t size = 0;                  ///< bytes, 1 .. 128 MiB
  ImportState before = Use::Unknown;  ///< its last use before this graph
  ImportState after = Use::Nothing;   ///< what it must be ready for after this graph; reached even when every pass is culled
};

/// A two-dimensional image of one layer, one sample a texel and one plane. Each level of a pyramid is half as wide and high as the one
/// before, and a version of its own to the graph: a pass may read one while it writes the next (Graph::level).
struct ImageDesc {
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 0, height = 0;  ///< texels of level 0
  uint32_t levels = 1;             ///< at most what halving leaves until 1 x 1
  friend bool operator==(const ImageDesc&, const ImageDesc&) = default;
};

/// What becomes of an image's old content when a pass writes it.
enum class Load : uint8_t {
  Keep,    ///< stays where nothing is drawn
  Clear,   ///< of targets alone: replaced by a value before anything is drawn
  Discard  ///< undefined: the pass writes all of it that anyone will read
};

/// As BufferImport. The graph changes the layout from that of `before` to those of its passes and in the end to that of `after`. A
/// swapchain's image is imported with `before` Unknown, or Present to draw over what it shows, and `after` Present: the submission waits
/// for the semaphore of its acquisition at ALL_COMMANDS, or at the first stage that uses it, and signals the one that presenting waits for.
/// The image is of type 2D, created with one layer and one sample, of `desc`'s format, size and number of levels: a VkImage can't be asked,
/// so that is the host's to keep. A multisampled or layered image is resolved or copied in a pass of the host's own instead.
struct ImageImport {
  VkImage handle = VK_NULL_HANDLE;
  ImageDesc desc = {};
  ImportState before = Use::Unknown;  ///< its last use before this graph, in whose layout it is
  ImportState after =
      Use::Nothing;             ///< what it must be ready for after this graph, in whose layout; reached even when every pass is culled
  VkImageUsageFlags usage = 0;  ///< what it was created for; where given, a use that it lacks (useState) is an error of compile()
};

/// An image on the device, as a pass sees it.
struct ImageHandle {
  VkImage image = VK_NULL_HANDLE;
  /// Of this level alone, of a depth format its depth. Null where the frame only copies the image.
  VkImageView view = VK_NULL_HANDLE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< during this pass: that of the use that it declared
  uint32_t level = 0;
};

}  // namespace rill
