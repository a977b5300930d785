#include "engine.hpp"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

namespace host {

void fail(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::exit(1);
}

void check(VkResult result, const char* what) {
  if (result == VK_SUCCESS) return;
  std::fprintf(stderr, "%s: VkResult %d\n", what, int(result));
  std::exit(1);
}

Engine::Engine(const std::function<const void*(VkInstance, VkPhysicalDevice)>& features) {
#ifdef HOST_VOLK
  check(volkInitialize(), "loading Vulkan");
#endif
  getInstanceProcAddr = vkGetInstanceProcAddr;
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "game";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  instanceInfo.pApplicationInfo = &application;
  check(vkCreateInstance(&instanceInfo, nullptr, &instance), "creating an instance");
#ifdef HOST_VOLK
  volkLoadInstance(instance);
#endif

  uint32_t count = 1;
  const VkResult listed = vkEnumeratePhysicalDevices(instance, &count, &physicalDevice);
  if ((listed != VK_SUCCESS && listed != VK_INCOMPLETE) || count == 0) fail("no Vulkan device");
  uint32_t families = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &families, nullptr);
  std::vector<VkQueueFamilyProperties> family(families);
  vkGetPhysicalDeviceQueueFamilyProperties(physicalDevice, &families, family.data());
  while (queueFamily < families && !(family[queueFamily].queueFlags & VK_QUEUE_GRAPHICS_BIT)) ++queueFamily;
  if (queueFamily == families) fail("no graphics queue family");

  const float priority = 1;
  VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queueInfo.queueFamilyIndex = queueFamily;
  queueInfo.queueCount = 1;
  queueInfo.pQueuePriorities = &priority;
  VkPhysicalDeviceTimelineSemaphoreFeatures timelines{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES};
  timelines.timelineSemaphore = VK_TRUE;
  timelines.pNext = const_cast<void*>(features(instance, physicalDevice));
  VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &timelines};
  deviceInfo.queueCreateInfoCount = 1;
  deviceInfo.pQueueCreateInfos = &queueInfo;
  check(vkCreateDevice(physicalDevice, &deviceInfo, nullptr, &device), "creating a device");
#ifdef HOST_VOLK
  volkLoadDevice(device);
#endif
  vkGetDeviceQueue(device, queueFamily, 0, &queue);

  VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  poolInfo.queueFamilyIndex = queueFamily;
  check(vkCreateCommandPool(device, &poolInfo, nullptr, &pool_), "creating a command pool");
  VkCommandBufferAllocateInfo allocateInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocateInfo.commandPool = pool_;
  allocateInfo.commandBufferCount = kFrames;
  check(vkAllocateCommandBuffers(device, &allocateInfo, commands_), "allocating command buffers");
  VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO, nullptr, VK_SEMAPHORE_TYPE_TIMELINE, 0};
  VkSemaphoreCreateInfo semaphoreInfo{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type};
  check(vkCreateSemaphore(device, &semaphoreInfo, nullptr, &timeline_), "creating a semaphore");
}

Engine::~Engine() {
  wait();
  vkDestroySemaphore(device, timeline_, nullptr);
  vkDestroyCommandPool(device, pool_, nullptr);
  vkDestroyDevice(device, nullptr);
  vkDestroyInstance(instance, nullptr);
}

Frame Engine::begin() {
  Frame frame;
  frame.number = submitted_ + 1;
  frame.commands = commands_[frame.number % kFrames];
  const uint64_t free = frame.number > kFrames ? frame.number - kFrames : 0;
  VkSemaphoreWaitInfo waitInfo{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
  waitInfo.semaphoreCount = 1;
  waitInfo.pSemaphores = &timeline_;
  waitInfo.pValues = &free;
  check(vkWaitSemaphores(device, &waitInfo, UINT64_MAX), "waiting for a frame");
  check(vkGetSemaphoreCounterValue(device, timeline_, &frame.completed), "asking for the last finished frame");
  VkCommandBufferBeginInfo beginInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  beginInfo.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(frame.commands, &beginInfo), "beginning a command buffer");
  return frame;
}

void Engine::end(const Frame& frame) {
  check(vkEndCommandBuffer(frame.commands), "recording");
  VkTimelineSemaphoreSubmitInfo values{VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO};
  values.signalSemaphoreValueCount = 1;
  values.pSignalSemaphoreValues = &frame.number;
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO, &values};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &frame.commands;
  submit.signalSemaphoreCount = 1;
  submit.pSignalSemaphores = &timeline_;
  check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE), "submitting");
  submitted_ = frame.number;
}

void Engine::wait() { check(vkDeviceWaitIdle(device), "waiting"); }

VkDeviceMemory Engine::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(physicalDevice, &memory);
  for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
    if (!(needs.memoryTypeBits >> type & 1) || (memory.memoryTypes[type].propertyFlags & wanted) != wanted) continue;
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
    VkDeviceMemory made = VK_NULL_HANDLE;
    check(vkAllocateMemory(device, &info, nullptr, &made), "allocating memory");
    return made;
  }
  fail("no suitable memory type");
}

Image Engine::createImage(VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage) {
  Image image{VK_NULL_HANDLE, VK_NULL_HANDLE, VK_NULL_HANDLE, format, width, height};
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {width, height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  check(vkCreateImage(device, &info, nullptr, &image.handle), "creating an image");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, image.handle, &needs);
  image.memory = allocate(needs, 0);
  check(vkBindImageMemory(device, image.handle, image.memory, 0), "binding an image");
  if (!(usage & (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT))) return image;
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = image.handle;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  const bool depth = (usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
  view.subresourceRange = {VkImageAspectFlags(depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), 0, 1, 0, 1};
  check(vkCreateImageView(device, &view, nullptr, &image.view), "creating a view");
  return image;
}

Buffer Engine::createBuffer(uint64_t size, VkBufferUsageFlags usage) {
  Buffer buffer;
  buffer.size = size;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  check(vkCreateBuffer(device, &info, nullptr, &buffer.handle), "creating a buffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, buffer.handle, &needs);
  buffer.memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device, buffer.handle, buffer.memory, 0), "binding a buffer");
  check(vkMapMemory(device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped), "mapping a buffer");
  return buffer;
}

void Engine::destroy(Image& image) {
  vkDestroyImageView(device, image.view, nullptr);
  vkDestroyImage(device, image.handle, nullptr);
  vkFreeMemory(device, image.memory, nullptr);
  image = {};
}

void Engine::destroy(Buffer& buffer) {
  vkDestroyBuffer(device, buffer.handle, nullptr);
  vkFreeMemory(device, buffer.memory, nullptr);
  buffer = {};
}

void Engine::change(const Frame& frame, const Image& image, VkImageLayout from, VkImageLayout to) {
  const bool depth = image.format == VK_FORMAT_D32_SFLOAT;
  VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.handle;
  barrier.subresourceRange = {VkImageAspectFlags(depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), 0, 1, 0, 1};
  vkCmdPipelineBarrier(frame.commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                       &barrier);
}

void Engine::clear(const Frame& frame, const Image& color, const VkClearColorValue& sky, const Image& depth, float farthest) {
  const VkImageLayout target = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  const VkImageSubresourceRange colors{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}, depths{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
  change(frame, color, VK_IMAGE_LAYOUT_UNDEFINED, target);
  change(frame, depth, VK_IMAGE_LAYOUT_UNDEFINED, target);
  vkCmdClearColorImage(frame.commands, color.handle, target, &sky, 1, &colors);
  const VkClearDepthStencilValue value{farthest, 0};
  vkCmdClearDepthStencilImage(frame.commands, depth.handle, target, &value, 1, &depths);
  change(frame, color, target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  change(frame, depth, target, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
}

void Engine::save(const Image& image, VkImageLayout layout, const char* file) {
  Buffer pixels = createBuffer(uint64_t{4} * image.width * image.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Frame frame = begin();
  change(frame, image, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {image.width, image.height, 1};
  vkCmdCopyImageToBuffer(frame.commands, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels.handle, 1, &region);
  end(frame);
  wait();
  std::FILE* out = std::fopen(file, "wb");
  if (!out) fail("cannot write the image");
  std::fprintf(out, "P6\n%u %u\n255\n", image.width, image.height);
  const auto* texel = static_cast<const unsigned char*>(pixels.mapped);
  for (uint64_t k = 0; k < uint64_t{image.width} * image.height; ++k) std::fwrite(texel + 4 * k, 1, 3, out);
  if (std::fclose(out) != 0) fail("cannot write the image");
  destroy(pixels);
}

}  // namespace host
