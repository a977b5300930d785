#include "gpu/pipeline.hpp"

#include <algorithm>
#include <bit>

#include "gpu/device_impl.hpp"
#include "gpu/shader_library.hpp"
#include "gpu/shader_reload.hpp"
#include "gpu/vulkan_error.hpp"
#include "gpu/workgroup_size.hpp"

namespace rill {
namespace {

constexpr size_t kMaxConstants = 32;
constexpr uint32_t kMaxPushBytes = 128;  // guaranteed by Vulkan

/// Shader if the device cannot run workgroups of this size, or not with these subgroups.
Expected<void> checkWorkgroups(const DeviceImpl& device, std::string_view shader, const WorkgroupSize& size, const SubgroupNeed& need) {
  const DeviceInfo& info = device.info;
  const uint32_t smallest = info.minSubgroupSize, largest = info.maxSubgroupSize;
  const auto refuse = [&](const std::string& needs, const std::string& supports) {
    return shaderError(shader, "needs " + needs + "; " + info.name + " supports " + supports);
  };
  const uint32_t(&limit)[3] = device.limits.maxComputeWorkGroupSize;
  if (size.invocations() > device.limits.maxComputeWorkGroupInvocations || size.x > limit[0] || size.y > limit[1] || size.z > limit[2])
    return refuse("workgroups of " + std::to_string(size.x) + " x " + std::to_string(size.y) + " x " + std::to_string(size.z),
                  "at most " + std::to_string(device.limits.maxComputeWorkGroupInvocations) + " invocations and " +
                      std::to_string(limit[0]) + " x " + std::to_string(limit[1]) + " x " + std::to_string(limit[2]));
  // Without subgroup size control, only the device's single size is supported.
  const bool supported = device.canSetSubgroupSize ? need.size >= smallest && need.size <= largest && std::has_single_bit(need.size)
                                                   : need.size == info.subgroupSize && smallest == largest;
  if (need.size != 0 && !supported)
    return refuse("subgroups of " + std::to_string(need.size), std::to_string(smallest) + " to " + std::to_string(largest));
  const uint32_t whole = need.size != 0 ? need.size : largest;  // the driver may take its largest
  if (need.full && size.x % std::max(whole, 1u) != 0)
    return shaderError(shader,
                       "needs full subgroups, but " + std::to_string(size.x) +
                           ", the first of the sizes of its workgroups, is not a multiple of " + std::to_string(whole) +
                           (need.size != 0 ? ", the subgroup size that it requires" : ", the largest subgroup size of " + info.name));
  if (need.size != 0 && size.invocations() > uint64_t{need.size} * device.maxWorkgroupSubgroups)
    return refuse(std::to_string((size.invocations() + need.size - 1) / need.size) + " subgroups a workgroup",
                  "at most " + std::to_string(device.maxWorkgroupSubgroups));
  return {};
}

}  // namespace

const EmbeddedShader* embeddedShader(const DeviceImpl& device, std::string_view name) {
  for (const auto& table : device.shaders.tables())
    if (const EmbeddedShader* shader = findShader(table, name)) return shader;
  return nullptr;
}

std::span<const uint32_t> embeddedSpirv(const DeviceImpl& device, std::string_view name) {
  if (device.reload)
    if (const auto words = device.reload->words(name); !words.empty()) return words;
  const EmbeddedShader* shader = embeddedShader(device, name);
  return shader ? shader->words : std::span<const uint32_t>();
}

Expected<Reflection> reflect(const DeviceImpl& device, std::initializer_list<std::string_view> shaders) {
  Reflection all;
  for (std::string_view name : shaders) {
    if (name.empty()) continue;
    const EmbeddedShader* shader = embeddedShader(device, name);
    if (!shader) return shaderError(name, "no SPIR-V given, and no embedded shader has this name");
    all.pushConstantBytes = std::max(all.pushConstantBytes, shader->pushConstantBytes);
    all.bindings.resize(std::max(all.bindings.size(), shader->bindings.size()));
    for (size_t k = 0; k < shader->bindings.size(); ++k) {
      const ShaderBinding& own = shader->bindings[k];
      ShaderBinding& merged = all.bindings[k];
      if (own.name.empty()) continue;
      if (!merged.name.empty() && (merged.name != own.name || merged.kind != own.kind))
        return shaderError(
            name, "binding " + std::to_string(k) + " is " + std::string(own.name) + "; another stage declares " + std::string(merged.name));
      merged = {own.name, own.kind, own.writes || merged.writes};
    }
  }
  for (size_t k = 0; k < all.bindings.size(); ++k) {
    if (all.bindings[k].name.empty())
      return shaderError(*shaders.begin(), "binding " + std::to_string(k) + " is not used; expected numbers without a gap");
    all.kinds.push_back(all.bindings[k].kind);
  }
  return all;
}

Error shaderError(std::string_view shader, std::string what) {
  return {ErrorKind::Shader, "shader '" + std::string(shader) + "': " + std::move(what)};
}

Expected<std::span<const uint32_t>> resolveSpirv(const DeviceImpl& device, std::string_view shader, std::span<const uint32_t> spirv) {
  if (spirv.empty()) {
    const auto words = embeddedSpirv(device, shader);
    if (words.empty()) return shaderError(shader, "no SPIR-V given, and no embedded shader has this name");
    return words;
  }
  constexpr uint32_t magic = 0x07230203, swapped = 0x03022307;
  constexpr size_t header = 5;  // words
  if (spirv[0] == swapped) return shaderError(shader, "the SPIR-V has the wrong byte order; expected that of this machine");
  if (spirv[0] != magic || spirv.size() < header)
    return shaderError(shader, "invalid SPIR-V; expected the magic number 0x07230203 and a header of five words");
  return spirv;
}

Error pipelineError(VkResult result, std::string_view shader) {
  Error error = vulkanError(result, "compiling the pipeline of shader '" + std::string(shader) + "'");
  if (error.kind == ErrorKind::Failed) error.kind = ErrorKind::Shader;
  return error;
}

Expected<ShaderModule> ShaderModule::make(DeviceImpl& device, std::string_view shader, std::span<const uint32_t> words) {
  VkShaderModuleCreateInfo create{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, words.size_bytes(), words.data()};
  VkShaderModule module = VK_NULL_HANDLE;
  if (VkResult r = device.vk.CreateShaderModule(device.handle, &create, device.callbacks, &module); r != VK_SUCCESS) {
    Error error = vulkanError(r, "creating the module of shader '" + std::string(shader) + "'");
    if (error.kind == ErrorKind::Failed) error.kind = ErrorKind::Shader;
    return error;
  }
  return ShaderModule(device, module);
}

ShaderModule::~ShaderModule() {
  if (handle_) device_.vk.DestroyShaderModule(device_.handle, handle_, device_.callbacks);
}

Constants::Constants(std::span<const uint32_t> values)
    : info_{uint32_t(values.size()), entries_.data(), values.size_bytes(), values.data()} {
  static_assert(kMaxConstants == std::tuple_size_v<decltype(entries_)>);
  for (uint32_t i = 0; i < values.size(); ++i) entries_[i] = {i, i * 4, 4};
}

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

Expected<VkPipeline> PipelineStore::build(DeviceImpl& device, const ComputePipeline& pipeline, std::span<const uint32_t> words) {
  // Shaders that ask for full subgroups are those that shuffle.
  std::vector<uint32_t> changed;
  if (pipeline.subgroups.full && device.reconvergence != Reconvergence::Workgroup)
    words = changed = withReconvergence(words, device.reconvergence);
  auto module = ShaderModule::make(device, pipeline.shader, words);
  if (!module) return module.error();
  const Constants constants(pipeline.constants);
  VkPipelineShaderStageRequiredSubgroupSizeCreateInfo subgroupSize{
      VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO};
  subgroupSize.requiredSubgroupSize = pipeline.subgroups.size;

  VkComputePipelineCreateInfo create{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  create.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  create.stage.module = module->handle();
  create.stage.pName = "main";
  create.stage.pSpecializationInfo = constants.info();
  if (pipeline.subgroups.full) create.stage.flags = VK_PIPELINE_SHADER_STAGE_CREATE_REQUIRE_FULL_SUBGROUPS_BIT;
  if (pipeline.subgroups.size != 0 && device.canSetSubgroupSize) create.stage.pNext = &subgroupSize;
  create.layout = pipeline.layout;
  VkPipeline handle = VK_NULL_HANDLE;
  if (VkResult r = device.vk.CreateComputePipelines(device.handle, device.cache, 1, &create, device.callbacks, &handle); r != VK_SUCCESS)
    return pipelineError(r, pipeline.shader);
  return handle;
}

Expected<const ComputePipeline*> PipelineStore::find(DeviceImpl& device, const ComputePipelineDesc& given) {
  ComputePipelineDesc desc = given;
  Reflection reflection;
  if (desc.spirv.empty()) {
    auto reflected = reflect(device, {desc.shader});
    if (!reflected) return reflected.error();
    reflection = *std::move(reflected);
    if (auto ok = reflection.complete(desc, desc.shader); !ok) return ok.error();
  }
  const SubgroupNeed subgroups{desc.requiredSubgroupSize, desc.fullSubgroups || desc.requiredSubgroupSize != 0};
  for (const auto& p : pipelines_)
    if (p->shader == desc.shader && p->pushBytes == desc.pushConstantBytes && p->subgroups == subgroups &&
        std::ranges::equal(p->set->kinds, desc.bindings) && std::ranges::equal(p->constants, desc.constants) &&
        std::ranges::equal(p->words, desc.spirv))
      return p.get();

  const auto words = resolveSpirv(device, desc.shader, desc.spirv);
  if (!words) return words.error();
  if (auto fits = checkWorkgroups(device, desc.shader, workgroupSize(*words, desc.constants), subgroups); !fits) return fits.error();

  auto pipeline = std::make_unique<ComputePipeline>();
  pipeline->shader = desc.shader;
  pipeline->bindings = std::move(reflection.bindings);
  pipeline->words.assign(desc.spirv.begin(), desc.spirv.end());
  pipeline->subgroups = subgroups;
  if (auto ok = begin(device, *pipeline, desc.bindings, desc.pushConstantBytes, desc.constants); !ok) return ok.error();
  auto handle = build(device, *pipeline, *words);
  return keep(device, pipelines_, std::move(pipeline), std::move(handle));
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

Expected<const ComputePipeline*> computePipeline(Device& device, const ComputePipelineDesc& desc) {
  return implOf(device).pipelines.find(implOf(device), desc);
}

size_t pipelineCount(const Device& device) { return implOf(device).pipelines.size(); }

}  // namespace rill
