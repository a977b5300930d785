#include "gpu/pipeline.hpp"

#include <algorithm>
#include <array>

#include "gpu/device_impl.hpp"
#include "gpu/shader_library.hpp"
#include "gpu/shader_reload.hpp"
#include "gpu/vulkan_error.hpp"

namespace rill {
namespace {

constexpr size_t kMaxConstants = 32;
constexpr uint32_t kMaxPushBytes = 128;  // the least that Vulkan guarantees

std::span<const uint32_t> libraryWords(const DeviceImpl& device, std::string_view name) {
  if (device.reload)
    if (const auto words = device.reload->words(name); !words.empty()) return words;
  for (const EmbeddedShader& shader : embeddedShaders())
    if (shader.name == name) return shader.words;
  return {};
}

Error shaderError(std::string_view shader, std::string what) {
  return {ErrorKind::Shader, "shader '" + std::string(shader) + "': " + std::move(what)};
}

}  // namespace

VkDescriptorType descriptorType(BindingKind kind) {
  switch (kind) {
    case BindingKind::Storage:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::Uniform:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingKind::TexelFloat4:
    case BindingKind::TexelUint:
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
    case BindingKind::TexelUint4:
      return VK_FORMAT_R32G32B32A32_UINT;
    default:
      return VK_FORMAT_UNDEFINED;
  }
}

uint32_t texelBytes(BindingKind kind) {
  const VkFormat format = texelFormat(kind);
  return format == VK_FORMAT_UNDEFINED ? 0 : format == VK_FORMAT_R32_UINT ? 4 : 16;
}

Expected<const SetLayout*> PipelineStore::setLayout(DeviceImpl& device, std::span<const BindingKind> kinds, std::string_view shader) {
  for (const auto& layout : layouts_)
    if (std::ranges::equal(layout->kinds, kinds)) return layout.get();
  const struct {
    VkDescriptorType type;
    const char* name;
    uint32_t most;
  } limits[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, "storage buffers", device.limits.maxPerStageDescriptorStorageBuffers},
                {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, "storage images", device.limits.maxPerStageDescriptorStorageImages},
                {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, "sampled images", device.limits.maxPerStageDescriptorSampledImages}};
  for (const auto& limit : limits) {
    const auto used = std::ranges::count(kinds, limit.type, descriptorType);
    if (uint64_t(used) > limit.most)
      return shaderError(shader, "needs " + std::to_string(used) + " " + limit.name + ", " + device.info.name + " binds at most " +
                                     std::to_string(limit.most));
  }
  std::vector<VkDescriptorSetLayoutBinding> bindings(kinds.size());
  for (uint32_t i = 0; i < kinds.size(); ++i) bindings[i] = {i, descriptorType(kinds[i]), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo create{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  create.bindingCount = uint32_t(bindings.size());
  create.pBindings = bindings.data();
  auto layout = std::make_unique<SetLayout>();
  layout->kinds.assign(kinds.begin(), kinds.end());
  if (VkResult r = device.vk.CreateDescriptorSetLayout(device.handle, &create, device.callbacks, &layout->handle); r != VK_SUCCESS)
    return vulkanError(r, "creating the descriptor set layout of shader '" + std::string(shader) + "'");
  layouts_.push_back(std::move(layout));
  return layouts_.back().get();
}

Expected<VkPipeline> PipelineStore::build(DeviceImpl& device, const ComputePipeline& pipeline, std::span<const uint32_t> words) {
  VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, words.size_bytes(), words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  if (VkResult r = device.vk.CreateShaderModule(device.handle, &moduleInfo, device.callbacks, &module); r != VK_SUCCESS) {
    Error error = vulkanError(r, "creating the module of shader '" + pipeline.shader + "'");
    if (error.kind == ErrorKind::Failed) error.kind = ErrorKind::Shader;
    return error;
  }
  std::array<VkSpecializationMapEntry, kMaxConstants> entries;
  for (uint32_t i = 0; i < pipeline.constants.size(); ++i) entries[i] = {i, i * 4, 4};
  const VkSpecializationInfo constants{uint32_t(pipeline.constants.size()), entries.data(), pipeline.constants.size() * 4,
                                       pipeline.constants.data()};
  VkPipelineShaderStageRequiredSubgroupSizeCreateInfo sized{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO};
  sized.requiredSubgroupSize = pipeline.requiredSubgroupSize;

  VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  create.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  create.stage.module = module;
  create.stage.pName = "main";
  create.stage.pSpecializationInfo = pipeline.constants.empty() ? nullptr : &constants;
  if (pipeline.requiredSubgroupSize != 0) {
    create.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
    if (device.sizedSubgroups) create.stage.pNext = &sized;
  }
  create.layout = pipeline.layout;
  VkPipeline handle = VK_NULL_HANDLE;
  const VkResult made = device.vk.CreateComputePipelines(device.handle, device.cache, 1, &create, device.callbacks, &handle);
  device.vk.DestroyShaderModule(device.handle, module, device.callbacks);
  if (made != VK_SUCCESS) {
    Error error = vulkanError(made, "compiling the pipeline of shader '" + pipeline.shader + "'");
    if (error.kind == ErrorKind::Failed) error.kind = ErrorKind::Shader;
    return error;
  }
  return handle;
}

Expected<const ComputePipeline*> PipelineStore::find(DeviceImpl& device, const ComputePipelineDesc& desc) {
  for (const auto& p : pipelines_)
    if (p->shader == desc.shader && p->pushBytes == desc.pushConstantBytes && p->requiredSubgroupSize == desc.requiredSubgroupSize &&
        std::ranges::equal(p->set->kinds, desc.bindings) && std::ranges::equal(p->constants, desc.constants) &&
        std::ranges::equal(p->words, desc.words))
      return p.get();

  const std::span<const uint32_t> words = desc.words.empty() ? libraryWords(device, desc.shader) : desc.words;
  if (words.empty()) return shaderError(desc.shader, "the library contains no such shader");
  if (desc.pushConstantBytes > kMaxPushBytes || desc.pushConstantBytes % 4 != 0)
    return shaderError(desc.shader,
                       std::to_string(desc.pushConstantBytes) + " bytes of push constants: a multiple of 4 up to 128 is possible");
  if (desc.constants.size() > kMaxConstants)
    return shaderError(desc.shader, "more than " + std::to_string(kMaxConstants) + " specialization constants");
  const uint32_t size = desc.requiredSubgroupSize;
  const DeviceInfo& info = device.info;
  // Where the driver takes no size, its only one will do.
  const bool possible = device.sizedSubgroups ? size >= info.minSubgroupSize && size <= info.maxSubgroupSize && (size & (size - 1)) == 0
                                              : size == info.subgroupSize && info.minSubgroupSize == info.maxSubgroupSize;
  if (size != 0 && !possible)
    return shaderError(desc.shader, "needs subgroups of " + std::to_string(size) + ", " + info.name + " has " +
                                        std::to_string(info.minSubgroupSize) + " to " + std::to_string(info.maxSubgroupSize));

  auto set = setLayout(device, desc.bindings, desc.shader);
  if (!set) return set.error();
  auto pipeline = std::make_unique<ComputePipeline>();
  pipeline->shader = desc.shader;
  pipeline->set = *set;
  pipeline->pushBytes = desc.pushConstantBytes;
  pipeline->constants.assign(desc.constants.begin(), desc.constants.end());
  pipeline->words.assign(desc.words.begin(), desc.words.end());
  pipeline->requiredSubgroupSize = size;

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, desc.pushConstantBytes};
  VkPipelineLayoutCreateInfo create{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  create.setLayoutCount = 1;
  create.pSetLayouts = &pipeline->set->handle;
  create.pushConstantRangeCount = desc.pushConstantBytes ? 1 : 0;
  create.pPushConstantRanges = &push;
  if (VkResult r = device.vk.CreatePipelineLayout(device.handle, &create, device.callbacks, &pipeline->layout); r != VK_SUCCESS)
    return vulkanError(r, "creating the pipeline layout of shader '" + pipeline->shader + "'");
  auto handle = build(device, *pipeline, words);
  if (!handle) {
    device.vk.DestroyPipelineLayout(device.handle, pipeline->layout, device.callbacks);
    return handle.error();
  }
  pipeline->handle = *handle;
  pipelines_.push_back(std::move(pipeline));
  return pipelines_.back().get();
}

Expected<void> PipelineStore::replace(DeviceImpl& device, std::string_view shader, std::span<const uint32_t> words) {
  for (const auto& pipeline : pipelines_) {
    if (pipeline->shader != shader || !pipeline->words.empty()) continue;
    auto handle = build(device, *pipeline, words);
    if (!handle) return handle.error();
    device.retired.add(device.clock.recording, VK_OBJECT_TYPE_PIPELINE, pipeline->handle);
    pipeline->handle = *handle;
  }
  return {};
}

void PipelineStore::destroy(DeviceImpl& device) {
  for (const auto& pipeline : pipelines_) {
    device.vk.DestroyPipeline(device.handle, pipeline->handle, device.callbacks);
    device.vk.DestroyPipelineLayout(device.handle, pipeline->layout, device.callbacks);
  }
  for (const auto& layout : layouts_) device.vk.DestroyDescriptorSetLayout(device.handle, layout->handle, device.callbacks);
  pipelines_.clear();
  layouts_.clear();
}

Expected<const ComputePipeline*> computePipeline(Device& device, const ComputePipelineDesc& desc) {
  return device.impl().pipelines.find(device.impl(), desc);
}

size_t pipelineCount(const Device& device) { return const_cast<Device&>(device).impl().pipelines.size(); }

}  // namespace rill
