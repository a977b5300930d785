// Everything in a frame that can fail: transient memory, descriptor sets, query pools. Also collects timings and read-backs.
#include <algorithm>
#include <bit>
#include <cassert>

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

  if (timingsEnabled && d.timestampMask) {
    for (const PassData& pass : passes)
      if (pass.alive) slot->timedNames.push_back(pass.name);
    const uint32_t needed = uint32_t(slot->timedNames.size()) + 1;
    if (needed > slot->queryCapacity) {
      d.retired.add(d.clock.completed, VK_OBJECT_TYPE_QUERY_POOL, slot->queries);
      slot->queries = VK_NULL_HANDLE;
      slot->queryCapacity = 0;
      VkQueryPoolCreateInfo create{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
      create.queryType = VK_QUERY_TYPE_TIMESTAMP;
      create.queryCount = std::bit_ceil(needed);
      if (VkResult r = d.vk.CreateQueryPool(d.handle, &create, d.callbacks, &slot->queries); r != VK_SUCCESS)
        return vulkanError(r, "creating " + std::to_string(create.queryCount) + " timestamp queries");
      slot->queryCapacity = create.queryCount;
    }
  }
  prepared = planComplete = true;
  return {};
}

/// Packs the read-backs into buffers of at most kSharedBufferBytes; a larger one has a buffer of its own.
Expected<void> GraphImpl::placeReadbacks(DeviceImpl& d, FrameSlot& target) {
  uint32_t buffer = 0;
  uint64_t bytes = 0;
  const auto finish = [&]() -> Expected<void> {
    if (target.readbacks.size() <= buffer) target.readbacks.resize(buffer + 1);
    if (bytes <= target.readbacks[buffer].size()) return {};
    auto made = d.createBuffer("read-back", std::max(bytes, std::bit_ceil(std::min(bytes, kSharedBufferBytes / 2))), MemoryKind::Readback);
    if (!made) return made.error();
    target.readbacks[buffer] = std::move(*made);
    return {};
  };
  for (Readback& readback : readbacks) {
    const uint64_t size = (readback.size + 15) & ~15ull;
    if (bytes + size > kSharedBufferBytes && bytes > 0) {
      if (auto ok = finish(); !ok) return ok;
      ++buffer;
      bytes = 0;
    }
    readback.buffer = buffer;
    readback.offset = bytes;
    bytes += size;
    target.pendingReadbacks.push_back({readback.ticket, buffer, readback.offset, readback.size});
  }
  return bytes > 0 ? finish() : Expected<void>{};
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

void GraphImpl::deduplicateSets() {
  SetDeduplication& s = setDedup;
  s.unique.clear();
  s.representative.resize(kernels.size());
  s.table.assign(std::bit_ceil(kernels.size() * 2 + 1), kNone);
  const auto key = [&](uint32_t k) { return std::span(bindings).subspan(kernels[k].bindings.first, kernels[k].bindings.count); };
  for (const PassData& pass : passes) {
    if (!pass.alive) continue;
    for (uint32_t k = pass.kernels.first; k < pass.kernels.first + pass.kernels.count; ++k) {
      uint64_t hash = reinterpret_cast<uintptr_t>(kernels[k].pipeline->set) * 0x9e3779b97f4a7c15ull;
      for (uint32_t resource : key(k)) hash = (std::rotl(hash, 5) ^ resource) * 0x9e3779b97f4a7c15ull;
      size_t at = (hash >> 32) & (s.table.size() - 1);
      for (;; at = (at + 1) & (s.table.size() - 1)) {
        const uint32_t other = s.table[at];
        if (other == kNone) {
          s.table[at] = k;
          s.unique.push_back(k);
          s.representative[k] = k;
          break;
        }
        if (kernels[other].pipeline->set == kernels[k].pipeline->set && std::ranges::equal(key(other), key(k))) {
          s.representative[k] = other;
          break;
        }
      }
    }
  }
}

namespace {

Expected<void> ensurePool(DeviceImpl& d, FrameSlot& slot, uint32_t sets, const DescriptorCounts& counts) {
  bool enough = sets <= slot.poolSets;
  for (size_t t = 0; t < counts.size(); ++t) enough = enough && counts[t] <= slot.poolCounts[t];
  if (enough) return {};
  if (slot.pool) d.vk.DestroyDescriptorPool(d.handle, slot.pool, d.callbacks);  // its frame has completed
  slot.pool = VK_NULL_HANDLE;
  const auto grow = [](uint32_t& have, uint32_t need) { have = std::max(have, std::bit_ceil(std::max(need, 1u))); };
  grow(slot.poolSets, sets);
  std::array<VkDescriptorPoolSize, kDescriptorTypes.size()> sizes;
  for (size_t t = 0; t < counts.size(); ++t) {
    grow(slot.poolCounts[t], counts[t]);
    sizes[t] = {kDescriptorTypes[t], slot.poolCounts[t]};
  }
  VkDescriptorPoolCreateInfo create{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  create.maxSets = slot.poolSets;
  create.poolSizeCount = uint32_t(sizes.size());
  create.pPoolSizes = sizes.data();
  if (VkResult r = d.vk.CreateDescriptorPool(d.handle, &create, d.callbacks, &slot.pool); r != VK_SUCCESS) {
    slot.poolSets = 0;
    return vulkanError(r, "creating a pool of " + std::to_string(create.maxSets) + " descriptor sets");
  }
  return {};
}

}  // namespace

Expected<void> GraphImpl::allocateSets(DeviceImpl& d, FrameSlot& target) {
  SetDeduplication& s = setDedup;
  DescriptorCounts counts{};
  s.layouts.clear();
  for (uint32_t k : s.unique) {
    s.layouts.push_back(kernels[k].pipeline->set->handle);
    for (BindingKind kind : kernels[k].pipeline->set->kinds)
      ++counts[size_t(std::ranges::find(kDescriptorTypes, descriptorType(kind)) - kDescriptorTypes.begin())];
  }
  if (s.unique.empty()) return {};
  if (auto ok = ensurePool(d, target, uint32_t(s.unique.size()), counts); !ok) return ok;
  s.sets.resize(s.unique.size());
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, target.pool, uint32_t(s.unique.size()),
                                       s.layouts.data()};
  if (VkResult r = d.vk.AllocateDescriptorSets(d.handle, &allocate, s.sets.data()); r != VK_SUCCESS)
    return vulkanError(r, "allocating " + std::to_string(s.unique.size()) + " descriptor sets");

  s.writes.clear();
  s.buffers.clear();
  s.views.clear();
  s.images.clear();
  s.buffers.reserve(counts[0] + counts[1]);  // the writes point into these vectors, so they must not reallocate
  s.views.reserve(counts[2]);
  s.images.reserve(counts[3] + counts[4]);
  for (size_t u = 0; u < s.unique.size(); ++u) {
    KernelData& kernel = kernels[s.unique[u]];
    kernel.set = s.sets[u];
    for (uint32_t b = 0; b < kernel.bindings.count; ++b) {
      const ResourceData& resource = resources[bindings[kernel.bindings.first + b]];
      const BindingKind kind = kernel.pipeline->set->kinds[b];
      VkWriteDescriptorSet write{
          VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, kernel.set, b, 0, 1, descriptorType(kind), nullptr, nullptr, nullptr};
      const uint32_t bytes = texelBytes(kind);
      if (resource.isImage) {
        const bool sampled = kind == BindingKind::SampledImage;
        s.images.push_back({VK_NULL_HANDLE, resource.view, sampled ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_GENERAL});
        write.pImageInfo = &s.images.back();
      } else if (bytes == 0) {
        const uint64_t limit = kind == BindingKind::Uniform ? d.limits.maxUniformBufferRange : d.limits.maxStorageBufferRange;
        if (resource.size > limit)
          return Error{ErrorKind::BadInput, "buffer " + quoted(resource.name) + " of " + std::to_string(resource.size) + " bytes; " +
                                                d.info.name + " binds at most " + std::to_string(limit)};
        s.buffers.push_back({resource.buffer, resource.offset, resource.size});
        write.pBufferInfo = &s.buffers.back();
      } else {
        const uint64_t size = resource.size / bytes * bytes;
        if (size == 0 || size / bytes > d.limits.maxTexelBufferElements)
          return Error{ErrorKind::BadInput, "texel buffer " + quoted(resource.name) + " of " + std::to_string(resource.size / bytes) +
                                                " texels; " + d.info.name + " supports 1 to " +
                                                std::to_string(d.limits.maxTexelBufferElements)};
        const VkFormat format = texelFormat(kind);
        auto view = std::ranges::find_if(target.views, [&](const FrameSlot::View& v) {
          return v.buffer == resource.buffer && v.offset == resource.offset && v.size == size && v.format == format;
        });
        if (view == target.views.end()) {
          VkBufferViewCreateInfo create{
              VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO, nullptr, 0, resource.buffer, format, resource.offset, size};
          VkBufferView handle = VK_NULL_HANDLE;
          if (VkResult r = d.vk.CreateBufferView(d.handle, &create, d.callbacks, &handle); r != VK_SUCCESS)
            return vulkanError(r, "creating a texel view of buffer " + quoted(resource.name));
          target.views.push_back({resource.buffer, resource.offset, size, format, handle});
          view = target.views.end() - 1;
        }
        s.views.push_back(view->handle);
        write.pTexelBufferView = &s.views.back();
      }
      s.writes.push_back(write);
    }
  }
  d.vk.UpdateDescriptorSets(d.handle, uint32_t(s.writes.size()), s.writes.data(), 0, nullptr);
  for (const PassData& pass : passes)
    if (pass.alive)
      for (uint32_t k = pass.kernels.first; k < pass.kernels.first + pass.kernels.count; ++k)
        kernels[k].set = kernels[s.representative[k]].set;
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

std::span<const std::byte> GraphImpl::data(Ticket ticket) {
  for (const auto& s : slots)
    for (FrameSlot::PendingReadback& pending : s->pendingReadbacks)
      if (pending.ticket == ticket.id) {
        if (s->frame > device->clock.completed || device->abandoned(s->frame)) return {};
        pending.returned = true;
        return {s->readbacks[pending.buffer].mapped() + pending.offset, pending.size};
      }
  return {};
}

}  // namespace rill
