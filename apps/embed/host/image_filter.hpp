#pragma once
// A compute pipeline for blur.comp with a descriptor set for two images, in plain Vulkan.
#include "engine.hpp"

namespace host {

class ImageFilter {
 public:
  explicit ImageFilter(Engine& engine);
  ~ImageFilter();
  ImageFilter(const ImageFilter&) = delete;
  ImageFilter& operator=(const ImageFilter&) = delete;

  /// Records a dispatch. The images stay in the given layouts. Once per frame, as it updates the descriptor set.
  void run(VkCommandBuffer commands, VkDescriptorImageInfo from, VkDescriptorImageInfo to, const int32_t (&direction)[2], uint32_t groupsX,
           uint32_t groupsY);

 private:
  Engine& engine_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace host
