// Everything in a frame that can fail: memory of buffers and images here, the rest in files of its own.
#include <algorithm>

#include "gpu/vulkan_error.hpp"
#include "graph/graph_impl.hpp"

namespace rill {

Expected<void> GraphImpl::prepare(Device& owner) {
  if (!compiled) return Error{ErrorKind::BadInput, "Graph::prepare: call compile() successfully before prepare()"};
  DeviceImpl& d = implOf(owner);
  if (device && device != &d)
    return Error{ErrorKind::BadInput, "Graph::prepare: the graph was prepared with another device; use one graph per device"};
  device = &d;
  prepared = planComplete = false;
  collect();
  if (usesGraphics && !d.hasGraphics)
    return Error{ErrorKind::NoDevice, "the frame uses graphics, but the queue family on '" + d.info.name + "' has none"};
  if (auto ok = queryImageRequirements(d); !ok) return ok;
  if (auto ok = checkSizes(d); !ok) return ok;
  if (auto ok = growHeaps(d); !ok) return ok;
  if (auto ok = resolveBuffers(d); !ok) return ok;

  auto found = std::ranges::find_if(slots, [&](const auto& s) { return s->reusable(d.clock); });
  if (found == slots.end()) {
    slots.push_back(std::make_unique<FrameSlot>(d));
    found = slots.end() - 1;
  }
  slot = found->get();
  slot->recycle();
  slot->frame = d.clock.recording;
  if (auto ok = resolveImages(d, *slot); !ok) return ok;

  deduplicateSets();
  if (auto ok = allocateSets(d, *slot); !ok) return ok;

  if (auto ok = placeReadbacks(d, *slot); !ok) return ok;

  if (auto ok = prepareTimings(d, *slot); !ok) return ok;
  prepared = planComplete = true;
  return {};
}

Expected<void> GraphImpl::queryImageRequirements(DeviceImpl& d) {
  bool changed = false;
  for (uint32_t index : plans[1].resources) {
    const ResourceData& image = resources[index];
    auto queried = images.query(d, {image.desc, image.usage}, names[image.name]);
    if (!queried) return queried.error();
    if (!*queried) continue;
    changed = true;
    previousPlan.valid = false;  // it was based on an estimate
  }
  if (changed) {
    placeTransients();
    planBarriers();
  }
  return {};
}

Expected<void> GraphImpl::checkSizes(const DeviceImpl& d) const {
  for (const ResourceData& resource : resources)
    if (!resource.isImage && resource.size > d.info.maxBufferBytes)
      return Error{ErrorKind::TooLarge, "buffer " + quoted(resource.name) + " of " + bytesText(resource.size) + "; " + d.info.name +
                                            " supports at most " + bytesText(d.info.maxBufferBytes) + " (" +
                                            std::string(d.info.maxBufferName) + ")"};
  return {};
}

Expected<void> GraphImpl::growHeaps(DeviceImpl& d) {
  const std::vector<uint64_t>& heapSizes = plans[0].heapSizes;
  if (heaps.size() < heapSizes.size()) heaps.resize(heapSizes.size());
  for (size_t i = 0; i < heapSizes.size(); ++i) {
    if (heapSizes[i] <= heaps[i].size()) continue;
    constexpr uint64_t step = 64 * 1024;
    auto heap = d.createBuffer("transients", std::min((heapSizes[i] + step - 1) / step * step, d.info.maxBufferBytes), MemoryKind::Device);
    if (!heap) return heap.error();
    heaps[i] = std::move(*heap);  // the old heap is retired, since frames in flight may still use it
  }
  return {};
}

Expected<void> GraphImpl::resolveBuffers(DeviceImpl& d) {
  const uint64_t alignment = std::max({d.limits.minStorageBufferOffsetAlignment, d.limits.minUniformBufferOffsetAlignment,
                                       d.limits.minTexelBufferOffsetAlignment, VkDeviceSize(4)});
  for (ResourceData& resource : resources) {
    if (resource.isImage) continue;
    if (resource.imported) {
      if (resource.offset % alignment != 0)
        return Error{ErrorKind::BadInput, "import " + quoted(resource.name) + ": offset " + std::to_string(resource.offset) +
                                              " is not a multiple of " + std::to_string(alignment)};
    } else if (resource.placement != kNone) {
      const Placement& place = plans[0].placements[resource.placement];
      resource.buffer = heaps[place.heap].handle();
      resource.offset = place.offset;
    }
  }
  return {};
}

Expected<void> GraphImpl::resolveImages(DeviceImpl& d, FrameSlot& target) {
  ImageRequirements all;  // combined, since any image may be placed in any heap
  for (uint32_t index : plans[1].resources) {
    const ResourceData& image = resources[index];
    const ImageRequirements own = images.requirements({image.desc, image.usage});
    all.alignment = std::max(all.alignment, own.alignment);
    all.memoryTypes &= own.memoryTypes;
  }
  if (auto ok = images.growHeaps(d, plans[1].heapSizes, all); !ok) return ok;
  for (size_t r = 0; r < resources.size(); ++r) {
    ResourceData& image = resources[r];
    if (!image.isImage || image.level != 0 || image.usage == 0) continue;
    const auto levels = std::span(resources).subspan(r, image.desc.levels);
    if (!image.imported) {
      const Placement& place = plans[1].placements[image.placement];
      auto made = images.place(d, {image.desc, image.usage}, place.heap, place.offset, names[image.name]);
      if (!made) return made.error();
      for (ResourceData& level : levels) {
        level.image = (*made)->image;
        if (!(*made)->views.empty()) level.view = (*made)->views[level.level];
      }
    } else if (image.usage & kViewUsage) {
      for (ResourceData& level : levels) {
        auto view = makeImageView(d, image.image, image.desc.format, level.level, names[image.name]);
        if (!view) return view.error();
        target.imageViews.push_back(level.view = *view);
      }
    }
  }
  images.retireUnused();
  imageBarriers.clear();
  for (const Transition& t : transitions)
    imageBarriers.push_back({VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                             nullptr,
                             t.scope.sourceStage,
                             t.scope.sourceAccess,
                             t.scope.targetStage,
                             t.scope.targetAccess,
                             t.from,
                             t.to,
                             VK_QUEUE_FAMILY_IGNORED,
                             VK_QUEUE_FAMILY_IGNORED,
                             resources[t.resource].image,
                             {aspectsOf(resources[t.resource].desc.format), resources[t.resource].level, 1, 0, 1}});
  return {};
}

}  // namespace rill
