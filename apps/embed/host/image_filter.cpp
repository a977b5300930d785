#include "image_filter.hpp"

namespace host {
namespace {

#include "blur_comp.inc"

constexpr VkDescriptorType kTypes[] = {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};

}  // namespace

ImageFilter::ImageFilter(Engine& engine) : engine_(engine) {
  const VkDevice device = engine.device;
  VkDescriptorSetLayoutBinding bindings[2] = {};
  VkDescriptorPoolSize sizes[2] = {};
  for (uint32_t k = 0; k < 2; ++k) {
    bindings[k] = {k, kTypes[k], 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    sizes[k] = {kTypes[k], 1};
  }
  VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  setInfo.bindingCount = 2;
  setInfo.pBindings = bindings;
  check(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout_), "creating a set layout");
  VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  poolInfo.maxSets = 1;
  poolInfo.poolSizeCount = 2;
  poolInfo.pPoolSizes = sizes;
  check(vkCreateDescriptorPool(device, &poolInfo, nullptr, &pool_), "creating a descriptor pool");
  VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  allocate.descriptorPool = pool_;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &setLayout_;
  check(vkAllocateDescriptorSets(device, &allocate, &set_), "allocating a descriptor set");

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, 8};
  VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layoutInfo.setLayoutCount = 1;
  layoutInfo.pSetLayouts = &setLayout_;
  layoutInfo.pushConstantRangeCount = 1;
  layoutInfo.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(device, &layoutInfo, nullptr, &layout_), "creating a pipeline layout");
  const VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, sizeof blur_comp, blur_comp};
  VkShaderModule shader = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device, &moduleInfo, nullptr, &shader), "creating a shader");
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, shader, "main", nullptr};
  info.layout = layout_;
  check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_), "creating a pipeline");
  vkDestroyShaderModule(device, shader, nullptr);
}

ImageFilter::~ImageFilter() {
  vkDestroyPipeline(engine_.device, pipeline_, nullptr);
  vkDestroyPipelineLayout(engine_.device, layout_, nullptr);
  vkDestroyDescriptorPool(engine_.device, pool_, nullptr);
  vkDestroyDescriptorSetLayout(engine_.device, setLayout_, nullptr);
}

void ImageFilter::run(VkCommandBuffer commands, VkDescriptorImageInfo from, VkDescriptorImageInfo to, const int32_t (&direction)[2],
                      uint32_t groupsX, uint32_t groupsY) {
  VkWriteDescriptorSet writes[2] = {{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}, {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}};
  for (uint32_t k = 0; k < 2; ++k) {
    writes[k].dstSet = set_;
    writes[k].dstBinding = k;
    writes[k].descriptorCount = 1;
    writes[k].descriptorType = kTypes[k];
    writes[k].pImageInfo = k == 0 ? &from : &to;
  }
  vkUpdateDescriptorSets(engine_.device, 2, writes, 0, nullptr);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
  vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof direction, direction);
  vkCmdDispatch(commands, groupsX, groupsY, 1);
}

}  // namespace host
