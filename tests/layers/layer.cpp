#include "layer.hpp"

#include <cstring>

namespace rill::layer {
namespace {

PFN_vkGetInstanceProcAddr nextInstance = nullptr;
PFN_vkGetDeviceProcAddr nextDevice = nullptr;

/// The loader's layer link in the pNext chain of a create info.
template <class Link, class Info>
Link* takeLink(const Info* info, VkStructureType type) {
  for (auto* next = static_cast<const VkBaseInStructure*>(info->pNext); next; next = next->pNext) {
    auto* link = reinterpret_cast<Link*>(const_cast<VkBaseInStructure*>(next));
    if (next->sType == type && link->function == VK_LAYER_LINK_INFO) return link;
  }
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* callbacks,
                                              VkInstance* instance) {
  auto* link = takeLink<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (!link) return VK_ERROR_INITIALIZATION_FAILED;
  nextInstance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult made = reinterpret_cast<PFN_vkCreateInstance>(nextInstance(VK_NULL_HANDLE, "vkCreateInstance"))(info, callbacks, instance);
  if (made == VK_SUCCESS) instanceCreated(*instance);
  return made;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* callbacks, VkDevice* device) {
  auto* link = takeLink<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (!link) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr instanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  nextDevice = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult made =
      reinterpret_cast<PFN_vkCreateDevice>(instanceProc(VK_NULL_HANDLE, "vkCreateDevice"))(physical, info, callbacks, device);
  if (made == VK_SUCCESS) deviceCreated(*device);
  return made;
}

PFN_vkVoidFunction own(const char* name) {
  if (std::strcmp(name, "vkCreateInstance") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&createInstance);
  if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&createDevice);
  return replacement(name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProc(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProc);
  if (auto function = own(name)) return function;
  return nextDevice ? nextDevice(device, name) : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProc(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getInstanceProc);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProc);
  if (auto function = own(name)) return function;
  return nextInstance ? nextInstance(instance, name) : nullptr;
}

}  // namespace

PFN_vkVoidFunction nextInstanceProc(VkInstance instance, const char* name) { return nextInstance(instance, name); }
PFN_vkVoidFunction nextDeviceProc(VkDevice device, const char* name) { return nextDevice(device, name); }

}  // namespace rill::layer

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiation) {
  negotiation->loaderLayerInterfaceVersion = 2;
  negotiation->pfnGetInstanceProcAddr = &rill::layer::getInstanceProc;
  negotiation->pfnGetDeviceProcAddr = &rill::layer::getDeviceProc;
  negotiation->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
