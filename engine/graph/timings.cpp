// Timings: a timestamp before and after each pass, read once the frame has completed.
#include <bit>

#include "gpu/vulkan_error.hpp"
#include "graph/graph_impl.hpp"

namespace rill {

Expected<void> GraphImpl::prepareTimings(DeviceImpl& d, FrameSlot& target) {
  if (!timingsEnabled || !d.timestampMask) return {};
  for (const PassData& pass : passes)
    if (pass.alive) target.timedNames.push_back(pass.name);
  const uint32_t needed = uint32_t(target.timedNames.size()) + 1;
  if (needed > target.queryCapacity) {
    d.retired.add(d.clock.completed, VK_OBJECT_TYPE_QUERY_POOL, target.queries);
    target.queries = VK_NULL_HANDLE;
    target.queryCapacity = 0;
    VkQueryPoolCreateInfo create{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    create.queryType = VK_QUERY_TYPE_TIMESTAMP;
    create.queryCount = std::bit_ceil(needed);
    if (VkResult r = d.vk.CreateQueryPool(d.handle, &create, d.callbacks, &target.queries); r != VK_SUCCESS)
      return vulkanError(r, "creating " + std::to_string(create.queryCount) + " timestamp queries");
    target.queryCapacity = create.queryCount;
  }
  return {};
}

void GraphImpl::collect() {
  if (!device) return;
  FrameSlot* newest = nullptr;
  for (const auto& s : slots) {
    if (!s->timingsPending || s->frame > device->clock.completed) continue;
    if (device->abandoned(s->frame))
      s->timingsPending = false;
    else if (s->frame > timingsFrame && (!newest || s->frame > newest->frame))
      newest = s.get();
  }
  if (!newest) return;
  newest->timingsPending = false;
  const uint32_t count = uint32_t(newest->timedNames.size());
  stamps.resize(count + 1);
  const VkResult got = device->vk.GetQueryPoolResults(device->handle, newest->queries, 0, count + 1, stamps.size() * sizeof(uint64_t),
                                                      stamps.data(), sizeof(uint64_t), VK_QUERY_RESULT_64_BIT);
  if (got != VK_SUCCESS) return;  // the frame has not completed, despite the host's clock
  timingsFrame = newest->frame;
  timings.clear();
  rowByName.assign(names.size(), kNone);
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t& row = rowByName[newest->timedNames[i]];
    if (row == kNone) {
      row = uint32_t(timings.size());
      timings.push_back({names[newest->timedNames[i]], 0, 0});
    }
    const uint64_t ticks = (stamps[i + 1] - stamps[i]) & device->timestampMask;
    timings[row].ms += double(ticks) * double(device->limits.timestampPeriod) * 1e-6;
    ++timings[row].runs;
  }
}

}  // namespace rill
