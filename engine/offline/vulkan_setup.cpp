// Vulkan setup: loader, instance, validation, choice of device.
#include <dlfcn.h>

#include <cstring>
#include <optional>

#include "gpu/function_table.hpp"
#include "gpu/reconvergence.hpp"
#include "gpu/vulkan_error.hpp"
#include "offline/context_impl.hpp"
#include "offline/device_choice.hpp"
#include "offline/device_list.hpp"

namespace rill::offline {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& context = *static_cast<ContextImpl*>(user);
  const std::lock_guard lock(context.messagesMutex);
  context.messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

struct Candidate {
  VkPhysicalDevice handle;
  std::string name;
  VkPhysicalDeviceType type;
};

}  // namespace

Expected<void> ContextImpl::openLoader() {
  // Never closed: threads and exit handlers of drivers may still run its code.
  void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!library) library = dlopen("libvulkan.so", RTLD_NOW | RTLD_LOCAL);
  if (!library) return Error{ErrorKind::NoDevice, "no Vulkan loader on this system: install libvulkan1 (libvulkan.so.1) and a driver"};
  get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
  createInstance = get ? reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance")) : nullptr;
  if (!createInstance)
    return Error{ErrorKind::NoDevice, "libvulkan.so.1 is not a Vulkan loader: it lacks vkGetInstanceProcAddr or vkCreateInstance"};
  return {};
}

Expected<void> ContextImpl::makeInstance(const ContextDesc& desc) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = desc.applicationName.c_str();
  application.pEngineName = "Rill";
  application.apiVersion = VK_API_VERSION_1_3;
  std::vector<const char*> extensions = desc.instanceExtensions;

  VkDebugUtilsMessengerCreateInfoEXT debug{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  debug.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  debug.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                      VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;  // without GENERAL messages of the loader
  debug.pfnUserCallback = onMessage;
  debug.pUserData = this;
  const VkValidationFeatureEnableEXT enable[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &debug};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enable;

  VkInstanceCreateInfo create{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  create.pApplicationInfo = &application;
  if (desc.validation) {
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    create.pNext = &features;
    create.enabledLayerCount = 1;
    create.ppEnabledLayerNames = &kValidationLayer;
  }
  create.enabledExtensionCount = uint32_t(extensions.size());
  create.ppEnabledExtensionNames = extensions.data();
  const VkResult made = createInstance(&create, nullptr, &instance);
  if (made == VK_ERROR_LAYER_NOT_PRESENT)
    return Error{ErrorKind::Failed,
                 std::string("validation was asked for, but ") + kValidationLayer + " is not installed (vulkan-validationlayers)"};
  if (made == VK_ERROR_INCOMPATIBLE_DRIVER) return Error{ErrorKind::NoDevice, "no Vulkan driver found (Debian: mesa-vulkan-drivers)"};
  if (made != VK_SUCCESS) return vulkanError(made, "creating a Vulkan instance");

#define RILL_LOAD(name)                                                 \
  vki.name = reinterpret_cast<PFN_vk##name>(get(instance, "vk" #name)); \
  if (!vki.name) return Error{ErrorKind::NoDevice, "the Vulkan instance lacks vk" #name};
  RILL_CONTEXT_INSTANCE_FUNCTIONS(RILL_LOAD)
#undef RILL_LOAD
  if (desc.validation) {
    auto createMessenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(get(instance, "vkCreateDebugUtilsMessengerEXT"));
    if (!createMessenger) return Error{ErrorKind::Failed, "validation was asked for, but VK_EXT_debug_utils is missing"};
    if (VkResult r = createMessenger(instance, &debug, nullptr, &messenger); r != VK_SUCCESS)
      return vulkanError(r, "creating the debug messenger");
  }
  return {};
}

std::optional<uint32_t> ContextImpl::familyOf(VkPhysicalDevice handle, const ContextDesc& desc) const {
  uint32_t count = 0;
  vki.GetPhysicalDeviceQueueFamilyProperties(handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vki.GetPhysicalDeviceQueueFamilyProperties(handle, &count, families.data());
  const auto find = [&](VkQueueFlags flags) -> std::optional<uint32_t> {
    for (uint32_t f = 0; f < count; ++f)
      if ((families[f].queueFlags & flags) == flags && (!desc.presents || desc.presents(instance, handle, f))) return f;
    return std::nullopt;
  };
  if (const auto draws = find(VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT); draws || desc.presents) return draws;
  return find(VK_QUEUE_COMPUTE_BIT);  // compute-only devices can simulate
}

Expected<std::vector<VkPhysicalDevice>> ContextImpl::physicalDevices() const {
  uint32_t count = 0;
  if (VkResult r = vki.EnumeratePhysicalDevices(instance, &count, nullptr); r != VK_SUCCESS && r != VK_ERROR_INITIALIZATION_FAILED)
    return vulkanError(r, "listing Vulkan devices");
  std::vector<VkPhysicalDevice> handles(count);
  if (count != 0) (void)vki.EnumeratePhysicalDevices(instance, &count, handles.data());
  handles.resize(count);
  return handles;
}

Expected<void> ContextImpl::usable(VkPhysicalDevice handle, const ContextDesc& desc) const {
  DeviceRequirements ignored;
  if (auto ok = appendRequired(get, instance, handle, ignored); !ok) return ok;
  if (familyOf(handle, desc)) return {};
  VkPhysicalDeviceProperties properties{};
  vki.GetPhysicalDeviceProperties(handle, &properties);
  return Error{ErrorKind::NoDevice,
               std::string("device '") + properties.deviceName + "' has no queue that " +
                   (desc.presents ? "supports compute, graphics and presentation to this display" : "supports compute")};
}

Expected<void> ContextImpl::chooseDevice(const ContextDesc& desc) {
  const std::string& wanted = desc.device;
  const auto handles = physicalDevices();
  if (!handles) return handles.error();
  std::vector<Candidate> devices;
  for (VkPhysicalDevice handle : *handles) {
    VkPhysicalDeviceProperties properties{};
    vki.GetPhysicalDeviceProperties(handle, &properties);
    devices.push_back({handle, properties.deviceName, properties.deviceType});
  }
  if (devices.empty()) return Error{ErrorKind::NoDevice, "no Vulkan device found (Debian: mesa-vulkan-drivers includes a CPU driver)"};

  std::optional<size_t> chosen;
  if (!wanted.empty()) {
    std::vector<std::string> names;
    for (const Candidate& candidate : devices) names.push_back(candidate.name);
    const auto aboutOption = [&](const Error& error) {
      return desc.deviceOrigin.empty() ? error : Error{error.kind, desc.deviceOrigin + ": " + error.message};
    };
    const auto named = offline::chooseDevice(names, wanted);
    if (!named) return aboutOption(named.error());
    chosen = *named;
    if (auto ok = usable(devices[*chosen].handle, desc); !ok) return aboutOption(ok.error());
  } else {
    std::string reasons;
    for (size_t i = 0; i < devices.size(); ++i) {
      if (auto ok = usable(devices[i].handle, desc); !ok)
        reasons += "\n  " + ok.error().message;
      else if (!chosen || deviceRank(devices[i].type) < deviceRank(devices[*chosen].type))
        chosen = i;
    }
    if (!chosen) return Error{ErrorKind::NoDevice, "no usable Vulkan device:" + reasons};
  }
  physicalDevice = devices[*chosen].handle;
  deviceName = devices[*chosen].name;

  queueFamily = *familyOf(physicalDevice, desc);
  return {};
}

/// Whether the device has the extension; its features are written to `features`, a structure for the chain.
bool ContextImpl::offers(const char* extension, void* features) const {
  if (!hasExtension(vki.EnumerateDeviceExtensionProperties, physicalDevice, extension)) return false;
  VkPhysicalDeviceFeatures2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, features, {}};
  vki.GetPhysicalDeviceFeatures2(physicalDevice, &all);
  return true;
}

uint32_t ContextImpl::validatedVersion() const {
  const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceLayerProperties>(get(nullptr, "vkEnumerateInstanceLayerProperties"));
  uint32_t count = 0;
  if (!enumerate || enumerate(&count, nullptr) != VK_SUCCESS) return 0;
  std::vector<VkLayerProperties> layers(count);
  if (enumerate(&count, layers.data()) < VK_SUCCESS) return 0;
  for (const VkLayerProperties& layer : layers)
    if (std::strcmp(layer.layerName, kValidationLayer) == 0) return layer.specVersion;
  return 0;
}

Expected<void> ContextImpl::makeDevice(const ContextDesc& desc) {
  DeviceRequirements needs;
  if (auto ok = appendRequired(get, instance, physicalDevice, needs); !ok) return ok;
  VkPhysicalDeviceVulkan12Features own{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  own.timelineSemaphore = VK_TRUE;  // the frame clock
  const float priority = 1;
  const VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, queueFamily, 1, &priority};
  std::vector<const char*> extensions = desc.deviceExtensions;
  VkPhysicalDeviceShaderMaximalReconvergenceFeaturesKHR maximal{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_MAXIMAL_RECONVERGENCE_FEATURES_KHR,
                                                                nullptr, VK_FALSE};
  VkPhysicalDeviceShaderSubgroupUniformControlFlowFeaturesKHR uniform{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_FEATURES_KHR, nullptr, VK_FALSE};
  // A layer older than the extension takes its shaders for errors.
  const bool mayBeMaximal = !desc.validation || validatedVersion() >= VK_MAKE_API_VERSION(0, 1, 3, 276);
  if (mayBeMaximal && offers(VK_KHR_SHADER_MAXIMAL_RECONVERGENCE_EXTENSION_NAME, &maximal) && maximal.shaderMaximalReconvergence) {
    extensions.push_back(VK_KHR_SHADER_MAXIMAL_RECONVERGENCE_EXTENSION_NAME);
    own.pNext = &maximal;
  } else if (offers(VK_KHR_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_EXTENSION_NAME, &uniform) && uniform.shaderSubgroupUniformControlFlow) {
    extensions.push_back(VK_KHR_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_EXTENSION_NAME);
    own.pNext = &uniform;
  }
  VkDeviceCreateInfo create{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, needs.chain(&own)};
  create.queueCreateInfoCount = 1;
  create.pQueueCreateInfos = &queueInfo;
  create.enabledExtensionCount = uint32_t(extensions.size());
  create.ppEnabledExtensionNames = extensions.data();
  if (VkResult r = vki.CreateDevice(physicalDevice, &create, nullptr, &device); r != VK_SUCCESS)
    return vulkanError(r, "opening device '" + deviceName + "'");

#define RILL_LOAD(name)                                                                \
  vk.name = reinterpret_cast<PFN_vk##name>(vki.GetDeviceProcAddr(device, "vk" #name)); \
  if (!vk.name) return Error{ErrorKind::NoDevice, "device '" + deviceName + "' lacks vk" #name};
  RILL_CONTEXT_DEVICE_FUNCTIONS(RILL_LOAD)
#undef RILL_LOAD
  vk.GetDeviceQueue(device, queueFamily, 0, &queue);

  if (!desc.pipelineCache.empty()) {
    VkPhysicalDeviceProperties properties{};
    vki.GetPhysicalDeviceProperties(physicalDevice, &properties);
    pipelines.emplace(desc.pipelineCache, properties, device,
                      PipelineCache::Functions{vk.CreatePipelineCache, vk.DestroyPipelineCache, vk.GetPipelineCacheData});
  }

  HostDevice host;
  host.instance = instance;
  host.physicalDevice = physicalDevice;
  host.device = device;
  host.queueFamily = queueFamily;
  host.getInstanceProcAddr = get;
  host.enabled = &needs.features;
  host.cache = pipelines ? pipelines->handle() : VK_NULL_HANDLE;
  host.reads = desc.reads;
  auto borrowed = Device::borrow(host);
  if (!borrowed) return borrowed.error();
  rill = std::move(*borrowed);
  return {};
}

}  // namespace rill::offline
