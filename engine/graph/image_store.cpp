#include "graph/image_store.hpp"

#include <algorithm>
#include <string>

#include "gpu/device_impl.hpp"
#include "gpu/device_memory.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {
namespace {

std::string imageText(const ImageKind& kind, std::string_view name) {
  return "image '" + std::string(name) + "' of " + std::to_string(kind.desc.width) + " x " + std::to_string(kind.desc.height) +
         " texels of format " + std::to_string(kind.desc.format);
}

VkImageCreateInfo createInfo(const ImageKind& kind) {
  VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  create.flags = VK_IMAGE_CREATE_ALIAS_BIT;
  create.imageType = VK_IMAGE_TYPE_2D;
  create.format = kind.desc.format;
  create.extent = {kind.desc.width, kind.desc.height, 1};
  create.mipLevels = kind.desc.levels;
  create.arrayLayers = 1;
  create.samples = VK_SAMPLE_COUNT_1_BIT;
  create.tiling = VK_IMAGE_TILING_OPTIMAL;
  create.usage = kind.usage;
  return create;
}

/// The first usage that the device does not support for this format; null: all are supported.
const char* unsupportedUsage(DeviceImpl& device, const ImageKind& kind) {
  VkFormatProperties properties{};
  device.instance.GetPhysicalDeviceFormatProperties(device.physical, kind.desc.format, &properties);
  constexpr struct {
    VkImageUsageFlags usage;
    VkFormatFeatureFlags feature;
    const char* what;
  } table[] = {{VK_IMAGE_USAGE_STORAGE_BIT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "storage images"},
               {VK_IMAGE_USAGE_SAMPLED_BIT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, "sampled images"},
               {VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, "color targets"},
               {VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT, "depth targets"},
               {VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_FORMAT_FEATURE_TRANSFER_SRC_BIT, "copies from images"},
               {VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_FORMAT_FEATURE_TRANSFER_DST_BIT, "copies to images"}};
  for (const auto& row : table)
    if ((kind.usage & row.usage) && !(properties.optimalTilingFeatures & row.feature)) return row.what;
  return nullptr;
}

}  // namespace

bool hasDepth(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_D16_UNORM_S8_UINT:
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return true;
    default:
      return false;
  }
}

VkImageAspectFlags aspectsOf(VkFormat format) {
  if (!hasDepth(format)) return VK_IMAGE_ASPECT_COLOR_BIT;
  const bool stencil =
      format == VK_FORMAT_D16_UNORM_S8_UINT || format == VK_FORMAT_D24_UNORM_S8_UINT || format == VK_FORMAT_D32_SFLOAT_S8_UINT;
  return VK_IMAGE_ASPECT_DEPTH_BIT | (stencil ? VK_IMAGE_ASPECT_STENCIL_BIT : 0);
}

Expected<VkImageView> makeImageView(DeviceImpl& device, VkImage image, VkFormat format, uint32_t level, std::string_view name) {
  VkImageViewCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  create.image = image;
  create.viewType = VK_IMAGE_VIEW_TYPE_2D;
  create.format = format;
  create.subresourceRange = {VkImageAspectFlags(hasDepth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), level, 1, 0, 1};
  VkImageView view = VK_NULL_HANDLE;
  if (VkResult r = device.vk.CreateImageView(device.handle, &create, device.callbacks, &view); r != VK_SUCCESS)
    return vulkanError(r, "creating a view of image '" + std::string(name) + "'");
  return view;
}

ImageStore::~ImageStore() {
  for (const Placed& placed : placed_) retire(placed);
  for (const Heap& heap : heaps_) device_->retired.add(device_->clock.recording, heap.block);
}

void ImageStore::retire(const Placed& placed) {
  for (VkImageView view : placed.handles.views) device_->retired.add(device_->clock.recording, VK_OBJECT_TYPE_IMAGE_VIEW, view);
  device_->retired.add(device_->clock.recording, VK_OBJECT_TYPE_IMAGE, placed.handles.image);
}

ImageRequirements ImageStore::requirements(const ImageKind& kind) const {
  const auto found = std::ranges::find(known_, kind, &Known::kind);
  return found != known_.end() ? found->needs
                               : ImageRequirements{(kind.desc.levels > 1 ? 24ull : 16ull) * kind.desc.width * kind.desc.height, 256};
}

Expected<bool> ImageStore::query(DeviceImpl& device, const ImageKind& kind, std::string_view name) {
  device_ = &device;
  if (std::ranges::find(known_, kind, &Known::kind) != known_.end()) return false;
  if (const char* what = unsupportedUsage(device, kind))
    return Error{ErrorKind::BadInput, imageText(kind, name) + ": " + device.info.name + " does not support " + what + " of this format"};
  if (std::max(kind.desc.width, kind.desc.height) > device.limits.maxImageDimension2D)
    return Error{ErrorKind::BadInput, imageText(kind, name) + ": " + device.info.name + " allows at most " +
                                          std::to_string(device.limits.maxImageDimension2D) + " per side"};
  const VkImageCreateInfo create = createInfo(kind);
  const VkDeviceImageMemoryRequirements ask{VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS, nullptr, &create,
                                            VK_IMAGE_ASPECT_COLOR_BIT};
  VkMemoryRequirements2 answer{VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2};
  device.vk.GetDeviceImageMemoryRequirements(device.handle, &ask, &answer);
  const VkMemoryRequirements& m = answer.memoryRequirements;
  known_.push_back({kind, {m.size, m.alignment, m.memoryTypeBits}});
  return true;
}

Expected<void> ImageStore::growHeaps(DeviceImpl& device, std::span<const uint64_t> sizes, const ImageRequirements& needs) {
  if (heaps_.size() < sizes.size()) heaps_.resize(sizes.size());
  const auto isSuitable = [&](const Heap& heap, uint64_t size) {
    const MemoryBlock& block = heap.block;
    return block.memory && heap.size >= size && (needs.memoryTypes >> block.memoryType & 1u) && block.offset % needs.alignment == 0;
  };
  for (uint32_t i = 0; i < sizes.size(); ++i) {
    Heap& heap = heaps_[i];
    if (isSuitable(heap, sizes[i])) continue;
    // Frames in flight may still use the old heap and its images.
    for (const Placed& placed : placed_)
      if (placed.heap == i) retire(placed);
    std::erase_if(placed_, [i](const Placed& placed) { return placed.heap == i; });
    device.retired.add(device.clock.recording, heap.block);
    heap = {};
    auto block = allocateMemory(device, {sizes[i], needs.alignment, needs.memoryTypes}, MemoryKind::Device, {"transient images"});
    if (!block) return block.error();
    heap = {*block, sizes[i]};
  }
  return {};
}

Expected<const ImageStore::Handles*> ImageStore::place(DeviceImpl& device, const ImageKind& kind, uint32_t heap, uint64_t offset,
                                                       std::string_view name) {
  for (Placed& placed : placed_)
    if (placed.heap == heap && placed.offset == offset && placed.kind == kind) {
      placed.used = true;
      return &placed.handles;
    }
  Placed made{kind, heap, offset, {}};
  const VkImageCreateInfo create = createInfo(kind);
  if (VkResult r = device.vk.CreateImage(device.handle, &create, device.callbacks, &made.handles.image); r != VK_SUCCESS)
    return vulkanError(r, "creating " + imageText(kind, name));
  VkResult bound =
      device.vk.BindImageMemory(device.handle, made.handles.image, heaps_[heap].block.memory, heaps_[heap].block.offset + offset);
  if (bound != VK_SUCCESS) {
    retire(made);
    return vulkanError(bound, "binding the memory of " + imageText(kind, name));
  }
  if (kind.usage & kViewUsage) {
    for (uint32_t level = 0; level < kind.desc.levels; ++level) {
      auto view = makeImageView(device, made.handles.image, kind.desc.format, level, name);
      if (!view) {
        retire(made);
        return view.error();
      }
      made.handles.views.push_back(*view);
    }
  }
  placed_.push_back(std::move(made));
  return &placed_.back().handles;
}

void ImageStore::retireUnused() {
  for (const Placed& placed : placed_)
    if (!placed.used) retire(placed);
  std::erase_if(placed_, [](const Placed& placed) { return !placed.used; });
  for (Placed& placed : placed_) placed.used = false;
}

}  // namespace rill
