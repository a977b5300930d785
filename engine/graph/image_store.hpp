#pragma once
// Transient images on the device: their memory requirements, heaps and handles, kept from frame to frame.
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"
#include "rill/graph.hpp"
#include "rill/memory.hpp"

namespace rill {

class DeviceImpl;

struct ImageKind {
  ImageDesc desc;
  VkImageUsageFlags usage = 0;
  friend bool operator==(const ImageKind&, const ImageKind&) = default;
};

struct ImageRequirements {
  uint64_t size = 0, alignment = 1;
  uint32_t memoryTypes = ~0u;
};

/// Usages that access an image through a view.
inline constexpr VkImageUsageFlags kViewUsage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                                VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;

class ImageStore {
 public:
  struct Handles {
    VkImage image = VK_NULL_HANDLE;
    std::vector<VkImageView> views;  ///< one per mip level; empty if no use needs views
  };

  ImageStore() = default;
  ~ImageStore();
  ImageStore(const ImageStore&) = delete;
  ImageStore& operator=(const ImageStore&) = delete;

  /// The queried requirements; before query(), an estimate of 16 bytes per texel (24 with mip levels).
  ImageRequirements requirements(const ImageKind& kind) const;
  /// Queries the device once per kind; true if the kind is new. BadInput, naming the image, if the device
  /// does not support it.
  Expected<bool> query(DeviceImpl& device, const ImageKind& kind, std::string_view name);
  /// Grows the heaps to at least these sizes, with the alignment and memory types of `needs`.
  Expected<void> growHeaps(DeviceImpl& device, std::span<const uint64_t> sizes, const ImageRequirements& needs);
  /// Returns the image of this kind at this placement, created on first use.
  Expected<const Handles*> place(DeviceImpl& device, const ImageKind& kind, uint32_t heap, uint64_t offset, std::string_view name);
  /// Retires images that have not been placed since the last call.
  void retireUnused();

 private:
  struct Known {
    ImageKind kind;
    ImageRequirements needs;
  };
  struct Heap {
    MemoryBlock block;
    uint64_t size = 0;
  };
  struct Placed {
    ImageKind kind;
    uint32_t heap = 0;
    uint64_t offset = 0;
    Handles handles;
    bool used = true;
  };
  void retire(const Placed& placed);

  DeviceImpl* device_ = nullptr;
  std::vector<Known> known_;
  std::vector<Heap> heaps_;
  std::vector<Placed> placed_;
};

/// A view of one mip level; for depth formats, of the depth aspect only.
Expected<VkImageView> makeImageView(DeviceImpl& device, VkImage image, VkFormat format, uint32_t level, std::string_view name);

bool hasDepth(VkFormat format);
/// All aspects of the format, as barriers need them.
VkImageAspectFlags aspectsOf(VkFormat format);

}  // namespace rill
