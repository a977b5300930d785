// Descriptor sets of a frame: one for kernels that bind the same.
#include <algorithm>
#include <bit>

#include "gpu/vulkan_error.hpp"
#include "graph/graph_impl.hpp"

namespace rill {
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

}  // namespace rill
