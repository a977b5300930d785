#include "plumbing.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "blur.spv.h"  // kBlurShader: glslangValidator --target-env vulkan1.3 --vn kBlurShader -o blur.spv.h blur.comp

namespace {

void check(VkResult result, const char* doing) {
  if (result == VK_SUCCESS) return;
  std::fprintf(stderr, "blur: %s failed with VkResult %d\n", doing, int(result));
  std::exit(1);
}

constexpr VkImageSubresourceLayers kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
constexpr uint64_t kBytes = uint64_t{Plumbing::width} * Plumbing::height * 4;

/// The blur in one direction as blur.comp does it, rounded to eight bits.
std::vector<uint8_t> blurred(const std::vector<uint8_t>& in, int dx, int dy) {
  const int width = int(Plumbing::width), height = int(Plumbing::height);
  const auto at = [&](int x, int y, int c) {
    return int(in[size_t((std::clamp(y, 0, height - 1) * width + std::clamp(x, 0, width - 1)) * 4 + c)]);
  };
  std::vector<uint8_t> out(in.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 4; ++c)
        out[size_t((y * width + x) * 4 + c)] = uint8_t((at(x - dx, y - dy, c) + 2 * at(x, y, c) + at(x + dx, y + dy, c) + 2) / 4);
  return out;
}

}  // namespace

std::span<const uint32_t> Plumbing::shader() const { return kBlurShader; }

uint32_t Plumbing::memoryType(uint32_t allowed, VkMemoryPropertyFlags wanted) const {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(physicalDevice, &memory);
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((allowed >> i & 1u) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  return 0;
}

bool Plumbing::open() {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  instanceInfo.pApplicationInfo = &application;
  check(vkCreateInstance(&instanceInfo, nullptr, &instance), "vkCreateInstance");

  uint32_t count = 16;
  VkPhysicalDevice devices[16];
  (void)vkEnumeratePhysicalDevices(instance, &count, devices);
  for (uint32_t i = 0; i < count && !physicalDevice; ++i) {
    if (auto able = rill::appendRequired(vkGetInstanceProcAddr, instance, devices[i], needs); able)
      physicalDevice = devices[i];
    else
      std::fprintf(stderr, "blur: %s\n", able.error().message.c_str());
  }
  if (!physicalDevice) {
    std::fprintf(stderr, "blur: no device that Rill can run on\n");
    return false;
  }
  VkQueueFamilyProperties families[16];
  count = 16;
  vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &count, families);
  while (queueFamily + 1 < count && !(families[queueFamily].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++queueFamily;

  needs.vulkan12.pNext = &needs.vulkan13;
  features = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &needs.vulkan12, needs.core};
  const float priority = 1;
  VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queueInfo.queueFamilyIndex = queueFamily;
  queueInfo.queueCount = 1;
  queueInfo.pQueuePriorities = &priority;
  VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
  deviceInfo.queueCreateInfoCount = 1;
  deviceInfo.pQueueCreateInfos = &queueInfo;
  check(vkCreateDevice(physicalDevice, &deviceInfo, nullptr, &device), "vkCreateDevice");
  vkGetDeviceQueue(device, queueFamily, 0, &queue_);
  const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, queueFamily};
  check(vkCreateCommandPool(device, &poolInfo, nullptr, &pool_), "vkCreateCommandPool");

  VkBufferCreateInfo bufferInfo{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  bufferInfo.size = kBytes;
  bufferInfo.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  check(vkCreateBuffer(device, &bufferInfo, nullptr, &staging_), "vkCreateBuffer");
  VkMemoryRequirements requirements;
  vkGetBufferMemoryRequirements(device, staging_, &requirements);
  const VkMemoryAllocateInfo allocate{
      VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, requirements.size,
      memoryType(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
  check(vkAllocateMemory(device, &allocate, nullptr, &stagingMemory_), "vkAllocateMemory");
  check(vkBindBufferMemory(device, staging_, stagingMemory_, 0), "vkBindBufferMemory");
  check(vkMapMemory(device, stagingMemory_, 0, kBytes, 0, reinterpret_cast<void**>(&mapped_)), "vkMapMemory");

  // What useState() says of the uses that blur.cpp makes of them, and of the copies here.
  source = makeImage(VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  result = makeImage(VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  texels_.resize(kBytes);
  for (size_t i = 0; i < texels_.size(); ++i) texels_[i] = uint8_t((i * 2654435761u) >> 13);
  std::memcpy(mapped_, texels_.data(), texels_.size());
  run([&](VkCommandBuffer commands) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.image = source.image;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                         &barrier);
    const VkBufferImageCopy region{0, 0, 0, kWhole, {}, {width, height, 1}};
    vkCmdCopyBufferToImage(commands, staging_, source.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  });
  return makePipeline();
}

Plumbing::Image Plumbing::makeImage(VkImageUsageFlags usage) {
  Image made;
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = VK_FORMAT_R8G8B8A8_UNORM;
  info.extent = {width, height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  check(vkCreateImage(device, &info, nullptr, &made.image), "vkCreateImage");
  VkMemoryRequirements requirements;
  vkGetImageMemoryRequirements(device, made.image, &requirements);
  const VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, requirements.size,
                                      memoryType(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
  check(vkAllocateMemory(device, &allocate, nullptr, &made.memory), "vkAllocateMemory");
  check(vkBindImageMemory(device, made.image, made.memory, 0), "vkBindImageMemory");
  return made;
}

bool Plumbing::makePipeline() {
  const VkDescriptorSetLayoutBinding bindings[] = {{0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
                                                   {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
  const VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, nullptr, 0, 2, bindings};
  check(vkCreateDescriptorSetLayout(device, &setInfo, nullptr, &setLayout_), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, 8};
  const VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, nullptr, 0, 1, &setLayout_, 1, &push};
  check(vkCreatePipelineLayout(device, &layoutInfo, nullptr, &layout), "vkCreatePipelineLayout");
  const VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0, sizeof kBlurShader, kBlurShader};
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(device, &moduleInfo, nullptr, &module), "vkCreateShaderModule");
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, module, "main", nullptr};
  info.layout = layout;
  check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "vkCreateComputePipelines");
  vkDestroyShaderModule(device, module, nullptr);

  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1}, {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1}};
  const VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, 1, 2, sizes};
  check(vkCreateDescriptorPool(device, &poolInfo, nullptr, &setPool_), "vkCreateDescriptorPool");
  const VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, setPool_, 1, &setLayout_};
  check(vkAllocateDescriptorSets(device, &allocate, &set), "vkAllocateDescriptorSets");
  return true;
}

void Plumbing::writeSet(VkDescriptorImageInfo from, VkDescriptorImageInfo to) {
  VkWriteDescriptorSet writes[2] = {{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}, {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET}};
  for (uint32_t i = 0; i < 2; ++i) {
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = i == 0 ? VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    writes[i].pImageInfo = i == 0 ? &from : &to;
  }
  vkUpdateDescriptorSets(device, 2, writes, 0, nullptr);
}

void Plumbing::run(const std::function<void(VkCommandBuffer)>& record) {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                             VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  check(vkAllocateCommandBuffers(device, &allocate, &commands), "vkAllocateCommandBuffers");
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
                                       nullptr};
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  record(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  check(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
  vkFreeCommandBuffers(device, pool_, 1, &commands);
}

bool Plumbing::isBlurred() {
  run([&](VkCommandBuffer commands) {
    const VkBufferImageCopy region{0, 0, 0, kWhole, {}, {width, height, 1}};
    vkCmdCopyImageToBuffer(commands, result.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging_, 1, &region);
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  });
  const std::vector<uint8_t> expected = blurred(blurred(texels_, 1, 0), 0, 1);
  size_t wrong = 0;
  for (size_t i = 0; i < expected.size(); ++i) wrong += std::abs(int(mapped_[i]) - int(expected[i])) > 1;
  if (wrong != 0) std::fprintf(stderr, "blur: %zu of %zu bytes are not those of the blurred image\n", wrong, expected.size());
  return wrong == 0;
}

Plumbing::~Plumbing() {
  if (device) {
    for (const Image& image : {source, result}) {
      vkDestroyImage(device, image.image, nullptr);
      vkFreeMemory(device, image.memory, nullptr);
    }
    vkDestroyBuffer(device, staging_, nullptr);
    vkFreeMemory(device, stagingMemory_, nullptr);
    vkDestroyDescriptorPool(device, setPool_, nullptr);
    vkDestroyPipeline(device, pipeline, nullptr);
    vkDestroyPipelineLayout(device, layout, nullptr);
    vkDestroyDescriptorSetLayout(device, setLayout_, nullptr);
    vkDestroyCommandPool(device, pool_, nullptr);
    vkDestroyDevice(device, nullptr);
  }
  if (instance) vkDestroyInstance(instance, nullptr);
}
