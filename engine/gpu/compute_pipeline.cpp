// Compute pipelines, and whether the device can run their workgroups.
#include <algorithm>
#include <bit>

#include "gpu/device_impl.hpp"
#include "gpu/pipeline.hpp"
#include "gpu/workgroup_size.hpp"

namespace rill {
namespace {

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

Expected<const ComputePipeline*> computePipeline(Device& device, const ComputePipelineDesc& desc) {
  return implOf(device).pipelines.find(implOf(device), desc);
}

}  // namespace rill
