#pragma once
// What any Vulkan program has and Rill does not give: instance, device, queue, images with memory, a submission that is waited for, and a
// compute pipeline of the program's own. The image that is blurred, and the check of what came out, are here as well.
#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <rill/device.hpp>
#include <span>
#include <vector>

struct Plumbing {
  struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
  };

  Plumbing() = default;
  ~Plumbing();
  Plumbing(const Plumbing&) = delete;
  Plumbing& operator=(const Plumbing&) = delete;

  /// Opens the first device that Rill can run on and uploads the test image to `source`. False, with a line on stderr, where that fails.
  bool open();
  /// Records into a command buffer, submits it and waits.
  void run(const std::function<void(VkCommandBuffer)>& record);
  /// Fills the set of `pipeline`: the image that it reads, the image that it writes.
  void writeSet(VkDescriptorImageInfo from, VkDescriptorImageInfo to);
  std::span<const uint32_t> shader() const;
  /// Whether `result`, in TRANSFER_SRC_OPTIMAL, is the test image blurred on the CPU, to a step in 255. Says on stderr what is not.
  bool isBlurred();

  static constexpr uint32_t width = 100, height = 60;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;
  rill::DeviceRequirements needs;      ///< enabled
  VkPhysicalDeviceFeatures2 features;  ///< their chain
  Image source;                        ///< uploaded, in TRANSFER_DST_OPTIMAL
  Image result;                        ///< never touched
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;

 private:
  uint32_t memoryType(uint32_t allowed, VkMemoryPropertyFlags wanted) const;
  Image makeImage(VkImageUsageFlags usage);
  bool makePipeline();

  std::vector<uint8_t> texels_;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkBuffer staging_ = VK_NULL_HANDLE;
  VkDeviceMemory stagingMemory_ = VK_NULL_HANDLE;
  uint8_t* mapped_ = nullptr;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool setPool_ = VK_NULL_HANDLE;
};
