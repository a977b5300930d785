#pragma once
// Transient images on the device: what they take of memory, the heaps that they lie in, and their handles, kept from frame to frame.
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

struct ImageNeeds {
  uint64_t size = 0, alignment = 1;
  uint32_t memoryTypes = ~0u;
};

/// Uses that see an image through a view.
inline constexpr VkImageUsageFlags kViewedUsage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;

class ImageStore {
 public:
  struct Handles {
    VkImage image = VK_NULL_HANDLE;
    std::vector<VkImageView> views;  ///< one a level; empty where no use needs them
  };

  ImageStore() = default;
  ~ImageStore();
  ImageStore(const ImageStore&) = delete;
  ImageStore& operator=(const ImageStore&) = delete;

  /// What the device said of this kind; before it was asked, 16 bytes a texel.
  ImageNeeds needs(const ImageKind& kind) const;
  /// Asks the device, once a kind; true where that was news. BadInput, naming the image, where the device cannot make it.
  Expected<bool> learn(DeviceImpl& device, const ImageKind& kind, std::string_view name);
  /// Heaps of at least these sizes, that images with the alignment and memory types of `needs` can lie in.
  Expected<void> growHeaps(DeviceImpl& device, std::span<const uint64_t> sizes, const ImageNeeds& needs);
  /// The image of this kind at this place, made if there is none yet.
  Expected<const Handles*> place(DeviceImpl& device, const ImageKind& kind, uint32_t heap, uint64_t offset, std::string_view name);
  /// Retires what has not been placed since the last sweep.
  void sweep();

 private:
  struct Known {
    ImageKind kind;
    ImageNeeds needs;
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

/// A view of one level; of a depth format its depth alone.
Expected<VkImageView> makeImageView(DeviceImpl& device, VkImage image, VkFormat format, uint32_t level, std::string_view name);

bool hasDepth(VkFormat format);
/// All that an image of this format has: what barriers name.
VkImageAspectFlags aspectsOf(VkFormat format);

}  // namespace rill
