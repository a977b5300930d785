#include "graph/frame_slot.hpp"

#include <algorithm>

namespace rill {
namespace {

// A read-back not queried for this many frames is dropped, so that a forgotten ticket does not hold memory forever.
constexpr uint64_t kReadbackTimeoutFrames = 16;

}  // namespace

FrameSlot::~FrameSlot() {
  for (const View& view : views) device.retired.add(frame, VK_OBJECT_TYPE_BUFFER_VIEW, view.handle);
  for (VkImageView view : imageViews) device.retired.add(frame, VK_OBJECT_TYPE_IMAGE_VIEW, view);
  device.retired.add(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool);
  device.retired.add(frame, VK_OBJECT_TYPE_QUERY_POOL, queries);
}

bool FrameSlot::reusable(const FrameClock& clock) const {
  if (frame > clock.completed) return false;
  return pendingReadbacks.empty() || clock.completed - frame >= kReadbackTimeoutFrames || device.abandoned(frame);
}

void FrameSlot::recycle() {
  for (const View& view : views) device.vk.DestroyBufferView(device.handle, view.handle, device.callbacks);
  for (VkImageView view : imageViews) device.vk.DestroyImageView(device.handle, view, device.callbacks);
  views.clear();
  imageViews.clear();
  pendingReadbacks.clear();
  timedNames.clear();
  timingsPending = false;
  if (pool) device.vk.ResetDescriptorPool(device.handle, pool, 0);
}

}  // namespace rill
