// Graphics pipelines for dynamic rendering.
#include <algorithm>
#include <optional>

#include "gpu/device_impl.hpp"
#include "gpu/pipeline.hpp"

namespace rill {

Expected<VkPipeline> PipelineStore::build(DeviceImpl& device, const GraphicsPipeline& pipeline, std::span<const uint32_t> vertex,
                                          std::span<const uint32_t> fragment) {
  const Constants constants(pipeline.constants);
  const auto stage = [&](VkShaderStageFlagBits bit, const ShaderModule& module) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = bit;
    info.module = module.handle();
    info.pName = "main";
    info.pSpecializationInfo = constants.info();
    return info;
  };
  auto vertexModule = ShaderModule::make(device, pipeline.shader, vertex);
  if (!vertexModule) return vertexModule.error();
  std::vector<VkPipelineShaderStageCreateInfo> stages{stage(VK_SHADER_STAGE_VERTEX_BIT, *vertexModule)};
  std::optional<ShaderModule> fragmentModule;  // not needed for depth-only drawing
  if (!fragment.empty()) {
    auto made = ShaderModule::make(device, pipeline.fragment, fragment);
    if (!made) return made.error();
    fragmentModule.emplace(*std::move(made));
    stages.push_back(stage(VK_SHADER_STAGE_FRAGMENT_BIT, *fragmentModule));
  }

  const VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = pipeline.topology;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depth.depthTestEnable = pipeline.depth != VK_FORMAT_UNDEFINED;  // depth writes require the test, possibly with ALWAYS
  depth.depthWriteEnable = pipeline.depthWrite;
  depth.depthCompareOp = pipeline.depthCompare;
  VkPipelineColorBlendAttachmentState attachment{};
  attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  attachment.blendEnable = pipeline.blend == Blend::Premultiplied;
  attachment.srcColorBlendFactor = attachment.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  attachment.dstColorBlendFactor = attachment.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  const std::vector<VkPipelineColorBlendAttachmentState> attachments(pipeline.colors.size(), attachment);
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = uint32_t(attachments.size());
  blend.pAttachments = attachments.data();
  constexpr VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = 2;
  dynamic.pDynamicStates = states;
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = uint32_t(pipeline.colors.size());
  rendering.pColorAttachmentFormats = pipeline.colors.data();
  rendering.depthAttachmentFormat = pipeline.depth;

  VkGraphicsPipelineCreateInfo create{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  create.stageCount = uint32_t(stages.size());
  create.pStages = stages.data();
  create.pVertexInputState = &input;
  create.pInputAssemblyState = &assembly;
  create.pViewportState = &viewport;
  create.pRasterizationState = &raster;
  create.pMultisampleState = &samples;
  create.pDepthStencilState = &depth;
  create.pColorBlendState = &blend;
  create.pDynamicState = &dynamic;
  create.layout = pipeline.layout;
  VkPipeline handle = VK_NULL_HANDLE;
  if (VkResult r = device.vk.CreateGraphicsPipelines(device.handle, device.cache, 1, &create, device.callbacks, &handle); r != VK_SUCCESS)
    return pipelineError(r, pipeline.shader);
  return handle;
}

Expected<const GraphicsPipeline*> PipelineStore::find(DeviceImpl& device, const GraphicsPipelineDesc& given) {
  GraphicsPipelineDesc desc = given;
  Reflection reflection;
  if (desc.vertexSpirv.empty() && desc.fragmentSpirv.empty()) {
    auto reflected = reflect(device, {desc.vertex, desc.fragment});
    if (!reflected) return reflected.error();
    reflection = *std::move(reflected);
    if (auto ok = reflection.complete(desc, desc.vertex); !ok) return ok.error();
  }
  for (const auto& p : graphics_)
    if (p->shader == desc.vertex && p->fragment == desc.fragment && p->pushBytes == desc.pushConstantBytes && p->depth == desc.depth &&
        p->depthCompare == desc.depthCompare && p->depthWrite == desc.depthWrite && p->blend == desc.blend &&
        p->topology == desc.topology && std::ranges::equal(p->set->kinds, desc.bindings) &&
        std::ranges::equal(p->constants, desc.constants) && std::ranges::equal(p->colors, desc.colors) &&
        std::ranges::equal(p->words, desc.vertexSpirv) && std::ranges::equal(p->fragmentWords, desc.fragmentSpirv))
      return p.get();

  if (!device.hasGraphics)
    return Error{ErrorKind::NoDevice,
                 "the queue family on '" + device.info.name + "' has no graphics, needed by shader '" + std::string(desc.vertex) + "'"};
  const auto lacksFeature = [&](VkFormat format, VkFormatFeatureFlags feature) {
    VkFormatProperties properties{};
    device.instance.GetPhysicalDeviceFormatProperties(device.physical, format, &properties);
    return (properties.optimalTilingFeatures & feature) != feature;
  };
  const auto formatError = [&](VkFormat format, const char* what) {
    return Error{ErrorKind::BadInput, std::string(what) + " target of format " + std::to_string(format) + ": " + device.info.name +
                                          " does not support it (shader '" + std::string(desc.vertex) + "')"};
  };
  const VkFormatFeatureFlags colorFeatures =
      VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | (desc.blend == Blend::Replace ? 0 : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT);
  for (const VkFormat format : desc.colors)
    if (lacksFeature(format, colorFeatures)) return formatError(format, "a color");
  if (desc.depth != VK_FORMAT_UNDEFINED && lacksFeature(desc.depth, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT))
    return formatError(desc.depth, "a depth");
  const auto vertex = resolveSpirv(device, desc.vertex, desc.vertexSpirv);
  if (!vertex) return vertex.error();
  const bool hasFragment = !desc.fragment.empty() || !desc.fragmentSpirv.empty();
  const auto fragment = hasFragment ? resolveSpirv(device, desc.fragment, desc.fragmentSpirv) : std::span<const uint32_t>();
  if (!fragment) return fragment.error();

  auto pipeline = std::make_unique<GraphicsPipeline>();
  pipeline->shader = desc.vertex;
  pipeline->fragment = desc.fragment;
  pipeline->bindings = std::move(reflection.bindings);
  pipeline->words.assign(desc.vertexSpirv.begin(), desc.vertexSpirv.end());
  pipeline->fragmentWords.assign(desc.fragmentSpirv.begin(), desc.fragmentSpirv.end());
  pipeline->bindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  pipeline->stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  pipeline->colors.assign(desc.colors.begin(), desc.colors.end());
  pipeline->depth = desc.depth;
  pipeline->depthCompare = desc.depthCompare;
  pipeline->depthWrite = desc.depthWrite;
  pipeline->blend = desc.blend;
  pipeline->topology = desc.topology;
  if (auto ok = begin(device, *pipeline, desc.bindings, desc.pushConstantBytes, desc.constants); !ok) return ok.error();
  auto handle = build(device, *pipeline, *vertex, *fragment);
  return keep(device, graphics_, std::move(pipeline), std::move(handle));
}

Expected<const GraphicsPipeline*> graphicsPipeline(Device& device, const GraphicsPipelineDesc& desc) {
  return implOf(device).pipelines.find(implOf(device), desc);
}

}  // namespace rill
