#include "contract/host.hpp"

#include <dlfcn.h>

#include <utility>

#include "contract/loader.hpp"

namespace rill::test {

PFN_vkGetInstanceProcAddr loaderFunction() {
  // Never closed: drivers keep threads and exit handlers.
  static void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  static const auto get = library ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr")) : nullptr;
  return get;
}

VkBool32 Host::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  Host& host = *static_cast<Host*>(user);
  const std::lock_guard lock(host.messagesMutex_);
  host.messages_.emplace_back(data->pMessage);
  return VK_FALSE;
}

std::unique_ptr<Host> Host::open(VkBool32 VkPhysicalDeviceVulkan13Features::*without) {
  std::unique_ptr<Host> host(new Host);
  if (host->makeInstance() && host->makeDevice(without)) return host;
  ADD_FAILURE() << "no Vulkan device with a validation layer";
  return nullptr;
}

bool Host::makeInstance() {
  const PFN_vkGetInstanceProcAddr get = loaderFunction();
  if (!get) return false;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
  VkDebugUtilsMessengerCreateInfoEXT debug{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  debug.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  debug.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  debug.pfnUserCallback = &Host::onMessage;
  debug.pUserData = this;
  const VkValidationFeatureEnableEXT enable[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &debug};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enable;
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_3;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;  // only for the test's messenger
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, &features};
  info.pApplicationInfo = &application;
  info.enabledLayerCount = info.enabledExtensionCount = 1;
  info.ppEnabledLayerNames = &layer;
  info.ppEnabledExtensionNames = &extension;
  if (!create || create(&info, nullptr, &instance) != VK_SUCCESS) return false;
#define RILL_LOAD(name) vki.name = reinterpret_cast<PFN_vk##name>(get(instance, "vk" #name));
  RILL_HOST_INSTANCE_FUNCTIONS(RILL_LOAD)
#undef RILL_LOAD
  return vki.CreateDebugUtilsMessengerEXT(instance, &debug, nullptr, &messenger_) == VK_SUCCESS;
}

bool Host::makeDevice(VkBool32 VkPhysicalDeviceVulkan13Features::*without) {
  uint32_t one = 1;
  if (vki.EnumeratePhysicalDevices(instance, &one, &physical) < VK_SUCCESS || one == 0) return false;
  uint32_t count = 0;
  vki.GetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vki.GetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  constexpr VkQueueFlags both = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT;
  while (family < count && (families[family].queueFlags & both) != both) ++family;
  if (family == count) return false;

  if (auto ok = appendRequired(loaderFunction(), instance, physical, needs); !ok) {
    ADD_FAILURE() << ok.error().message;
    return false;
  }
  if (without) needs.vulkan13.*without = VK_FALSE;
  const float priority = 1;
  const VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority};
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, needs.chain()};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  if (vki.CreateDevice(physical, &info, nullptr, &device) != VK_SUCCESS) return false;
#define RILL_LOAD(name) vk.name = reinterpret_cast<PFN_vk##name>(vki.GetDeviceProcAddr(device, "vk" #name));
  RILL_HOST_DEVICE_FUNCTIONS(RILL_LOAD)
#undef RILL_LOAD
  vk.GetDeviceQueue(device, family, 0, &queue_);
  return true;
}

Host::~Host() {
  if (device) vk.DestroyDevice(device, nullptr);
  if (messenger_) vki.DestroyDebugUtilsMessengerEXT(instance, messenger_, nullptr);
  if (instance) vki.DestroyInstance(instance, nullptr);
}

HostDevice Host::hostDevice() {
  HostDevice hostDevice;
  hostDevice.instance = instance;
  hostDevice.physicalDevice = physical;
  hostDevice.device = device;
  hostDevice.queueFamily = family;
  hostDevice.getInstanceProcAddr = Interceptor::getInstanceProcAddr();
  hostDevice.enabled = &needs.features;
  return hostDevice;
}

void Host::run(const std::function<void(VkCommandBuffer)>& record, bool submits) {
  VkCommandPool pool = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, family};
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  ASSERT_EQ(vk.CreateCommandPool(device, &poolInfo, nullptr, &pool), VK_SUCCESS);
  ASSERT_EQ(vk.CreateFence(device, &fenceInfo, nullptr, &fence), VK_SUCCESS);
  const VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             1};
  ASSERT_EQ(vk.AllocateCommandBuffers(device, &allocate, &commands), VK_SUCCESS);
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  ASSERT_EQ(vk.BeginCommandBuffer(commands, &begin), VK_SUCCESS);
  record(commands);
  ASSERT_EQ(vk.EndCommandBuffer(commands), VK_SUCCESS);
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  if (submits) {
    {
      const std::lock_guard lock(queueMutex_);
      ASSERT_EQ(vk.QueueSubmit(queue_, 1, &submit, fence), VK_SUCCESS);
    }
    ASSERT_EQ(vk.WaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX), VK_SUCCESS);
  }
  vk.DestroyFence(device, fence, nullptr);
  vk.DestroyCommandPool(device, pool, nullptr);
}

std::vector<std::string> Host::takeMessages() {
  const std::lock_guard lock(messagesMutex_);
  return std::exchange(messages_, {});
}

}  // namespace rill::test
