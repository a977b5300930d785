#pragma once
// What one frame in flight holds on the device. A slot is used again once the host's clock says that its frame has completed.
#include <array>
#include <cstdint>
#include <vector>

#include "gpu/device_impl.hpp"

namespace rill {

/// Descriptors of each type of kDescriptorTypes. Its type is written out: GCC puts one that it deduces among the writable variables.
inline constexpr std::array<VkDescriptorType, 5> kDescriptorTypes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                                                     VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER,
                                                                     VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE};
using DescriptorCounts = std::array<uint32_t, kDescriptorTypes.size()>;

struct FrameSlot {
  struct View {
    VkBuffer buffer;
    uint64_t offset, size;
    VkFormat format;
    VkBufferView handle;
  };
  struct Delivery {
    uint64_t ticket;
    uint32_t buffer;  ///< of FrameSlot::readbacks
    uint64_t offset, size;
    bool seen = false;
  };

  explicit FrameSlot(DeviceImpl& owner) : device(owner) {}
  ~FrameSlot();
  FrameSlot(const FrameSlot&) = delete;
  FrameSlot& operator=(const FrameSlot&) = delete;

  /// Its frame has completed and nobody can still want its read-backs.
  bool reusable(const FrameClock& clock) const;
  /// Forgets the last frame; what it held on the device stays for the next one where it can.
  void recycle();

  DeviceImpl& device;
  uint64_t frame = 0;
  // Views live for one frame: handle values of imported buffers recur, so no view can be found again by its buffer.
  std::vector<View> views;
  std::vector<VkImageView> imageViews;  ///< of imported images
  VkDescriptorPool pool = VK_NULL_HANDLE;
  uint32_t poolSets = 0;  ///< what the pool was made for
  DescriptorCounts poolCounts{};
  VkQueryPool queries = VK_NULL_HANDLE;
  uint32_t queryCapacity = 0;
  std::vector<uint32_t> timedNames;  ///< the pass between each two timestamps
  bool timingsPending = false;
  std::vector<Buffer> readbacks;  ///< none of them larger than a buffer may be
  std::vector<Delivery> deliveries;
};

/// Kernels with equal layouts and equal buffers share a descriptor set: which kernel stands for each.
struct SetSharing {
  std::vector<uint32_t> table;      ///< open addressing: kernel indices
  std::vector<uint32_t> standsFor;  ///< one a kernel
  std::vector<uint32_t> unique;     ///< kernels that need a set of their own
  std::vector<VkDescriptorSetLayout> layouts;
  std::vector<VkDescriptorSet> sets;
  std::vector<VkWriteDescriptorSet> writes;
  std::vector<VkDescriptorBufferInfo> buffers;
  std::vector<VkBufferView> views;
  std::vector<VkDescriptorImageInfo> images;
};

}  // namespace rill
