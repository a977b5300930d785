#include "gpu/pipeline.hpp"

#include <algorithm>

#include "gpu/device_impl.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {
namespace {

constexpr uint32_t kMaxPushBytes = 128;  // guaranteed by Vulkan

}  // namespace

VkDescriptorType descriptorType(BindingKind kind) {
  switch (kind) {
    case BindingKind::Storage:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::Uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingKind::TexelFloat4:
    case BindingKind::TexelUint:
    case BindingKind::TexelUint2:
    case BindingKind::TexelUint4:
      return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    case BindingKind::StorageImage:
      return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    case BindingKind::SampledImage:
      return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
  }
  return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

VkFormat texelFormat(BindingKind kind) {
  switch (kind) {
    case BindingKind::TexelFloat4:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
    case BindingKind::TexelUint:
      return VK_FORMAT_R32_UINT;
    case BindingKind::TexelUint2:
      return VK_FORMAT_R32G32_UINT;
    case BindingKind::TexelUint4:
      return VK_FORMAT_R32G32B32A32_UINT;
    default:
      return VK_FORMAT_UNDEFINED;
  }
}

uint32_t texelBytes(BindingKind kind) {
  switch (texelFormat(kind)) {
    case VK_FORMAT_UNDEFINED:
      return 0;
    case VK_FORMAT_R32_UINT:
      return 4;
    case VK_FORMAT_R32G32_UINT:
      return 8;
    default:
      return 16;
  }
}

Expected<const SetLayout*> PipelineStore::setLayout(DeviceImpl& device, std::span<const BindingKind> kinds, VkShaderStageFlags stages,
                                                    std::string_view shader) {
  for (const auto& layout : layouts_)
    if (layout->stages == stages && std::ranges::equal(layout->kinds, kinds)) return layout.get();
  const struct {
    VkDescriptorType type;
    const char* name;
    uint32_t max;
  } limits[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, "storage buffers", device.limits.maxPerStageDescriptorStorageBuffers},
                {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, "storage images", device.limits.maxPerStageDescriptorStorageImages},
                {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, "sampled images", device.limits.maxPerStageDescriptorSampledImages}};
  for (const auto& limit : limits) {
    const auto used = std::ranges::count(kinds, limit.type, descriptorType);
    if (uint64_t(used) > limit.max)
      return shaderError(shader, "needs " + std::to_string(used) + " " + limit.name + "; " + device.info.name + " binds at most " +
                                     std::to_string(limit.max));
  }
  std::vector<VkDescriptorSetLayoutBinding> bindings(kinds.size());
  for (uint32_t i = 0; i < kinds.size(); ++i) bindings[i] = {i, descriptorType(kinds[i]), 1, stages, nullptr};
  VkDescriptorSetLayoutCreateInfo create{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  create.bindingCount = uint32_t(bindings.size());
  create.pBindings = bindings.data();
  auto layout = std::make_unique<SetLayout>();
  layout->kinds.assign(kinds.begin(), kinds.end());
  layout->stages = stages;
  if (VkResult r = device.vk.CreateDescriptorSetLayout(device.handle, &create, device.callbacks, &layout->handle); r != VK_SUCCESS)
    return vulkanError(r, "creating the descriptor set layout of shader '" + std::string(shader) + "'");
  layouts_.push_back(std::move(layout));
  return layouts_.back().get();
}

Expected<void> PipelineStore::begin(DeviceImpl& device, Pipeline& pipeline, std::span<const BindingKind> bindings, uint32_t pushBytes,
                                    SpecializationConstants constants) {
  if (pushBytes > kMaxPushBytes || pushBytes % 4 != 0)
    return shaderError(pipeline.shader, std::to_string(pushBytes) + " bytes of push constants; expected a multiple of 4, at most 128");
  if (constants.size() > kMaxConstants)
    return shaderError(pipeline.shader,
                       std::to_string(constants.size()) + " specialization constants; expected at most " + std::to_string(kMaxConstants));
  auto set = setLayout(device, bindings, pipeline.stages, pipeline.shader);
  if (!set) return set.error();
  pipeline.set = *set;
  pipeline.pushBytes = pushBytes;
  pipeline.constants.assign(constants.begin(), constants.end());

  const VkPushConstantRange push{pipeline.stages, 0, pushBytes};
  VkPipelineLayoutCreateInfo create{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  create.setLayoutCount = 1;
  create.pSetLayouts = &pipeline.set->handle;
  create.pushConstantRangeCount = pushBytes ? 1 : 0;
  create.pPushConstantRanges = &push;
  if (VkResult r = device.vk.CreatePipelineLayout(device.handle, &create, device.callbacks, &pipeline.layout); r != VK_SUCCESS)
    return vulkanError(r, "creating the pipeline layout of shader '" + pipeline.shader + "'");
  return {};
}

Expected<void> PipelineStore::replace(DeviceImpl& device, std::string_view shader, std::span<const uint32_t> words) {
  const auto swapHandle = [&](Pipeline& pipeline, VkPipeline handle) {
    device.retired.add(device.clock.recording, VK_OBJECT_TYPE_PIPELINE, pipeline.handle);
    pipeline.handle = handle;
  };
  for (const auto& pipeline : pipelines_) {
    if (pipeline->shader != shader || !pipeline->words.empty()) continue;
    auto handle = build(device, *pipeline, words);
    if (!handle) return handle.error();
    swapHandle(*pipeline, *handle);
  }
  for (const auto& pipeline : graphics_) {
    const bool vertex = pipeline->shader == shader && pipeline->words.empty();
    const bool fragment = pipeline->fragment == shader && pipeline->fragmentWords.empty();
    if (!vertex && !fragment) continue;
    const auto spirvOf = [&](std::string_view name, std::span<const uint32_t> own) {
      return own.empty() ? embeddedSpirv(device, name) : own;
    };
    auto handle = build(device, *pipeline, vertex ? words : spirvOf(pipeline->shader, pipeline->words),
                        fragment ? words : spirvOf(pipeline->fragment, pipeline->fragmentWords));
    if (!handle) return handle.error();
    swapHandle(*pipeline, *handle);
  }
  return {};
}

void PipelineStore::destroyLayout(DeviceImpl& device, const Pipeline& pipeline) {
  device.vk.DestroyPipelineLayout(device.handle, pipeline.layout, device.callbacks);
}

void PipelineStore::destroy(DeviceImpl& device) {
  const auto destroyOne = [&](const Pipeline& pipeline) {
    device.vk.DestroyPipeline(device.handle, pipeline.handle, device.callbacks);
    destroyLayout(device, pipeline);
  };
  for (const auto& pipeline : pipelines_) destroyOne(*pipeline);
  for (const auto& pipeline : graphics_) destroyOne(*pipeline);
  for (const auto& layout : layouts_) device.vk.DestroyDescriptorSetLayout(device.handle, layout->handle, device.callbacks);
  pipelines_.clear();
  graphics_.clear();
  layouts_.clear();
}

size_t pipelineCount(const Device& device) { return implOf(device).pipelines.size(); }

}  // namespace rill
