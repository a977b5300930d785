// Resources of a frame. Sizes, formats and states are checked where they are declared.
#include <algorithm>
#include <bit>

#include "graph/graph_impl.hpp"

namespace rill {
namespace {

const char* usageName(VkImageUsageFlags usage) {
  switch (usage) {
    case VK_IMAGE_USAGE_STORAGE_BIT:
      return "VK_IMAGE_USAGE_STORAGE_BIT";
    case VK_IMAGE_USAGE_SAMPLED_BIT:
      return "VK_IMAGE_USAGE_SAMPLED_BIT";
    case VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT:
      return "VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT";
    case VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT:
      return "VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT";
    case VK_IMAGE_USAGE_TRANSFER_SRC_BIT:
      return "VK_IMAGE_USAGE_TRANSFER_SRC_BIT";
    default:
      return "VK_IMAGE_USAGE_TRANSFER_DST_BIT";
  }
}

constexpr uint32_t kMaxImageSide = 32768;  // above any device limit, and sizes in bytes still fit in 64 bits

}  // namespace

ResourceRef GraphImpl::add(ResourceData resource) {
  compiled = prepared = false;
  const std::string_view kind = resource.kind();
  const auto reject = [&](std::string_view what) { fail(std::string(kind) + quoted(resource.name) + std::string(what)); };
  if (resource.isImage) {
    if (resource.desc.format == VK_FORMAT_UNDEFINED) reject(" has no format");
    if (resource.desc.format == VK_FORMAT_S8_UINT) reject(": stencil-only formats are not supported");
    if (resource.desc.width == 0 || resource.desc.height == 0) reject(": size is 0");
    if (std::max(resource.desc.width, resource.desc.height) > kMaxImageSide)
      reject(" of " + std::to_string(resource.desc.width) + " x " + std::to_string(resource.desc.height) + " texels; expected at most " +
             std::to_string(kMaxImageSide) + " per side");
    const uint32_t maxLevels = uint32_t(std::bit_width(std::max({resource.desc.width, resource.desc.height, 1u})));
    if (resource.desc.levels == 0 || resource.desc.levels > maxLevels) {
      reject(" has " + std::to_string(resource.desc.levels) + " levels; expected 1 to " + std::to_string(maxLevels));
      resource.desc.levels = 1;
    }
  } else {
    if (resource.size == 0) reject(": size is 0");
    if (resource.size > kMaxBufferBytes)
      reject(" of " + std::to_string(resource.size) + " bytes; expected at most " + std::to_string(kMaxBufferBytes));
  }
  for (ImportState* state : {&resource.before, &resource.after}) {
    if (isUse(state->use)) continue;
    fail("import " + quoted(resource.name) + ": invalid Use value " + std::to_string(unsigned(state->use)));
    state->use = Use::Nothing;
  }
  if (resource.imported) checkStates(resource);
  const uint32_t index = uint32_t(resources.size());
  for (resource.level = 0; resource.level < (resource.isImage ? resource.desc.levels : 1); ++resource.level) resources.push_back(resource);
  return {index, 0, epoch};
}

void GraphImpl::checkStates(const ResourceData& import) {
  const auto reject = [&](const std::string& what) { fail("import " + quoted(import.name) + ": " + what); };
  if (import.after == Use::Unknown) reject("Use::Unknown is not a valid final state");
  for (const ImportState& state : {import.before, import.after}) {
    const UseRow row = useRow(state);
    const bool hasLayout = row.layout != VK_IMAGE_LAYOUT_UNDEFINED;
    if (state.isCustom) {
      if (import.isImage && !hasLayout) reject("a custom state of an image needs a layout");
      if (!import.isImage && hasLayout) reject("a custom state of a buffer must not have a layout");
      if (!row.stage && (row.read | row.write)) reject("the custom state has accesses but no stages");
      continue;
    }
    if (state.use != Use::Nothing && state.use != Use::Unknown && (import.isImage ? !hasLayout : isImageOnly(state.use)))
      reject(std::string("Use::") + row.name + " is not a use of " + (import.isImage ? "an image" : "a buffer"));
    else if (import.createdUsage != 0 && (row.usage & ~import.createdUsage) != 0)
      reject(std::string("Use::") + row.name + " is one of its states, but it was created without " + usageName(row.usage));
  }
  if (import.after.isCustom && import.after.custom.layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
    reject("VK_IMAGE_LAYOUT_PREINITIALIZED is not a valid final layout");
}

bool GraphImpl::checkUsage(uint32_t pass, const ResourceData& resource, Use use) {
  if (!resource.isImage || resource.createdUsage == 0 || (useRow(use).usage & ~resource.createdUsage) == 0) return true;
  fail("pass '" + std::string(names[passes[pass].name]) + "' uses import " + quoted(resource.name) + " with Use::" + useRow(use).name +
       ", but it was created without " + usageName(useRow(use).usage));
  return false;
}

}  // namespace rill
