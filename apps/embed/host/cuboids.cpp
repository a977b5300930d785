#include "cuboids.hpp"

#include <array>
#include <cstring>

namespace host {
namespace {

#include "cuboid_frag.inc"
#include "cuboid_vert.inc"

struct Push {
  Matrix clipFromLocal;
  float low[4], high[4], color[4];  ///< the fourth ones: direction to the light in the cuboid's frame
};

Push pushOf(const Matrix& clipFromWorld, const Cuboid& cuboid) {
  constexpr float kToLight[3] = {-0.3f, 0.84f, 0.45f};
  Push push{clipFromWorld * cuboid.pose, {}, {}, {}};
  float* const light[3] = {&push.low[3], &push.high[3], &push.color[3]};
  for (int a = 0; a < 3; ++a) {
    push.low[a] = cuboid.low[a], push.high[a] = cuboid.high[a], push.color[a] = cuboid.color[a];
    for (int b = 0; b < 3; ++b) *light[a] += cuboid.pose.m[a][b] * kToLight[b];
  }
  return push;
}

}  // namespace

VkRenderPass Cuboids::makePass(VkAttachmentLoadOp load, VkImageLayout color, VkImageLayout depth) {
  const VkImageLayout colorTarget = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                      depthTarget = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
  const VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_STORE;
  const VkAttachmentDescription attachments[] = {{0, color_.format, VK_SAMPLE_COUNT_1_BIT, load, store, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                                  VK_ATTACHMENT_STORE_OP_DONT_CARE, color, colorTarget},
                                                 {0, depth_.format, VK_SAMPLE_COUNT_1_BIT, load, store, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                                  VK_ATTACHMENT_STORE_OP_DONT_CARE, depth, depthTarget}};
  const VkAttachmentReference colorReference{0, colorTarget}, depthReference{1, depthTarget};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &colorReference;
  subpass.pDepthStencilAttachment = &depthReference;
  // Waits for earlier passes on the images, including the previous frame.
  const VkPipelineStageFlags stages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                      VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  const VkAccessFlags writes = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  const VkSubpassDependency dependency{VK_SUBPASS_EXTERNAL,
                                       0,
                                       stages,
                                       stages,
                                       writes,
                                       writes | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
                                       0};
  VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  info.attachmentCount = 2;
  info.pAttachments = attachments;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &dependency;
  VkRenderPass pass = VK_NULL_HANDLE;
  check(vkCreateRenderPass(engine_.device, &info, nullptr, &pass), "creating a render pass");
  return pass;
}

Cuboids::Cuboids(Engine& engine, const Image& color, const Image& depth) : engine_(engine), color_(color), depth_(depth) {
  first_ = makePass(VK_ATTACHMENT_LOAD_OP_CLEAR, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_UNDEFINED);
  over_ = makePass(VK_ATTACHMENT_LOAD_OP_LOAD, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
  const VkImageView views[] = {color.view, depth.view};
  VkFramebufferCreateInfo framebuffer{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
  framebuffer.renderPass = first_;
  framebuffer.attachmentCount = 2;
  framebuffer.pAttachments = views;
  framebuffer.width = color.width;
  framebuffer.height = color.height;
  framebuffer.layers = 1;
  check(vkCreateFramebuffer(engine.device, &framebuffer, nullptr, &framebuffer_), "creating a framebuffer");

  const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push)};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(engine.device, &layout, nullptr, &layout_), "creating a pipeline layout");

  const auto shader = [&](const uint32_t* words, size_t bytes) {
    const VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, bytes, words};
    VkShaderModule made = VK_NULL_HANDLE;
    check(vkCreateShaderModule(engine.device, &info, nullptr, &made), "creating a shader");
    return made;
  };
  std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
  for (VkPipelineShaderStageCreateInfo& stage : stages) {
    stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    stage.pName = "main";
  }
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = shader(cuboid_vert, sizeof cuboid_vert);
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = shader(cuboid_frag, sizeof cuboid_frag);
  const VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport area{0, 0, float(color.width), float(color.height), 0, 1};
  const VkRect2D scissor{{0, 0}, {color.width, color.height}};
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  viewport.pViewports = &area;
  viewport.pScissors = &scissor;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depthState{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depthState.depthTestEnable = depthState.depthWriteEnable = VK_TRUE;
  depthState.depthCompareOp = VK_COMPARE_OP_GREATER;  // reversed: nearer is larger
  VkPipelineColorBlendAttachmentState attachment{};
  attachment.colorWriteMask = 0xf;
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = 1;
  blend.pAttachments = &attachment;
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
  info.stageCount = uint32_t(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depthState;
  info.pColorBlendState = &blend;
  info.layout = layout_;
  info.renderPass = first_;
  check(vkCreateGraphicsPipelines(engine.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_), "creating a pipeline");
  for (const VkPipelineShaderStageCreateInfo& stage : stages) vkDestroyShaderModule(engine.device, stage.module, nullptr);
}

Cuboids::~Cuboids() {
  vkDestroyPipeline(engine_.device, pipeline_, nullptr);
  vkDestroyPipelineLayout(engine_.device, layout_, nullptr);
  vkDestroyFramebuffer(engine_.device, framebuffer_, nullptr);
  vkDestroyRenderPass(engine_.device, over_, nullptr);
  vkDestroyRenderPass(engine_.device, first_, nullptr);
}

void Cuboids::drawFirst(const Frame& frame, const Matrix& clipFromWorld, const Cuboid* cuboids, uint32_t count) {
  draw(first_, frame, clipFromWorld, cuboids, count);
}

void Cuboids::drawOver(const Frame& frame, const Matrix& clipFromWorld, const Cuboid* cuboids, uint32_t count) {
  draw(over_, frame, clipFromWorld, cuboids, count);
}

void Cuboids::draw(VkRenderPass pass, const Frame& frame, const Matrix& clipFromWorld, const Cuboid* cuboids, uint32_t count) {
  VkClearValue clear[2] = {};
  clear[0].color = {{0.55f, 0.65f, 0.75f, 1}};
  clear[1].depthStencil = {0, 0};  // infinity
  VkRenderPassBeginInfo begin{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
  begin.renderPass = pass;
  begin.framebuffer = framebuffer_;
  begin.renderArea.extent = {color_.width, color_.height};
  begin.clearValueCount = 2;
  begin.pClearValues = clear;
  vkCmdBeginRenderPass(frame.commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(frame.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  for (uint32_t k = 0; k < count; ++k) {
    const Push push = pushOf(clipFromWorld, cuboids[k]);
    vkCmdPushConstants(frame.commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
    vkCmdDraw(frame.commands, 36, 1, 0, 0);
  }
  vkCmdEndRenderPass(frame.commands);
}

}  // namespace host
