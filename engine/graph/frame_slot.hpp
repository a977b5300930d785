#pragma once
// Device objects of one frame in flight. A slot is reused once its frame has completed.
#include <array>
#include <cstdint>
#include <vector>

#include "gpu/device_impl.hpp"

namespace rill {

/// The type is explicit because GCC places a std::array with deduced arguments in writable memory.
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
  struct PendingReadback {
    uint64_t ticket;
    uint32_t buffer;  ///< of FrameSlot::readbacks
    uint64_t offset, size;
    bool returned = false;
  };

  explicit FrameSlot(DeviceImpl& owner) : device(owner) {}
  ~FrameSlot();
  FrameSlot(const FrameSlot&) = delete;
  FrameSlot& operator=(const FrameSlot&) = delete;

  /// Whether the frame has completed and its read-backs were abandoned or have timed out.
  bool reusable(const FrameClock& clock) const;
  /// Clears the last frame, keeping device objects that the next one can reuse.
  void recycle();

  DeviceImpl& device;
  uint64_t frame = 0;
  // Views live for one frame: handle values of imported buffers may be reused, so views cannot be cached by buffer.
  std::vector<View> views;
  std::vector<VkImageView> imageViews;  ///< of imported images
  VkDescriptorPool pool = VK_NULL_HANDLE;
  uint32_t poolSets = 0;  ///< capacity of the pool
  DescriptorCounts poolCounts{};
  VkQueryPool queries = VK_NULL_HANDLE;
  uint32_t queryCapacity = 0;
  std::vector<uint32_t> timedNames;  ///< names of the passes between consecutive timestamps
  bool timingsPending = false;
  std::vector<Buffer> readbacks;  ///< each at most kSharedBufferBytes, or one read-back
  std::vector<PendingReadback> pendingReadbacks;
};

/// Kernels with equal layouts and equal resources share a descriptor set.
struct SetDeduplication {
  std::vector<uint32_t> table;           ///< open addressing: kernel indices
  std::vector<uint32_t> representative;  ///< per kernel: the kernel whose set it shares
  std::vector<uint32_t> unique;          ///< kernels that need a set of their own
  std::vector<VkDescriptorSetLayout> layouts;
  std::vector<VkDescriptorSet> sets;
  std::vector<VkWriteDescriptorSet> writes;
  std::vector<VkDescriptorBufferInfo> buffers;
  std::vector<VkBufferView> views;
  std::vector<VkDescriptorImageInfo> images;
};

}  // namespace rill
