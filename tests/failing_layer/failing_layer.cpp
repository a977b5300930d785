// A Vulkan layer that makes one call fail: RILL_TEST_FAIL="vkQueueSubmit2 3 -4" has the third vkQueueSubmit2 return -4
// (VK_ERROR_DEVICE_LOST). Supports one instance and one device.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan_core.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

struct Plan {
  char function[64] = "";
  int call = 0, result = 0;
  Plan() {
    if (const char* text = std::getenv("RILL_TEST_FAIL"); text && std::sscanf(text, "%63s %d %d", function, &call, &result) != 3) call = 0;
  }
};

PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr nextDeviceProc = nullptr;

/// Whether this call of `function` is the one to fail.
bool fails(const char* function, VkResult& result) {
  static const Plan plan;
  static std::atomic<int> calls{0};
  if (std::strcmp(plan.function, function) != 0 || ++calls != plan.call) return false;
  result = static_cast<VkResult>(plan.result);
  return true;
}

#define FAILING_FUNCTIONS(X) \
  X(AcquireNextImageKHR)     \
  X(AllocateMemory)          \
  X(CreateBuffer)            \
  X(CreateComputePipelines)  \
  X(CreateShaderModule)      \
  X(QueuePresentKHR)         \
  X(QueueSubmit2)            \
  X(WaitSemaphores)

template <class Function>
struct Failing;
template <class... Arguments>
struct Failing<VkResult(VKAPI_PTR*)(Arguments...)> {
  using Pointer = VkResult(VKAPI_PTR*)(Arguments...);
  template <int Index>
  struct Of {
    static inline Pointer next = nullptr;
    static inline const char* name = nullptr;
    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
      VkResult result;
      return fails(name, result) ? result : next(arguments...);
    }
  };
};

enum FunctionIndex : int {
#define INDEX(function) k##function,
  FAILING_FUNCTIONS(INDEX)
#undef INDEX
};

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
  nextInstanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  return reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProc(VK_NULL_HANDLE, "vkCreateInstance"))(info, callbacks, instance);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* callbacks, VkDevice* device) {
  auto* link = takeLink<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (!link) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr instanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  nextDeviceProc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult made =
      reinterpret_cast<PFN_vkCreateDevice>(instanceProc(VK_NULL_HANDLE, "vkCreateDevice"))(physical, info, callbacks, device);
  if (made != VK_SUCCESS) return made;
#define FIND(function)                                               \
  Failing<PFN_vk##function>::Of<k##function>::name = "vk" #function; \
  Failing<PFN_vk##function>::Of<k##function>::next = reinterpret_cast<PFN_vk##function>(nextDeviceProc(*device, "vk" #function));
  FAILING_FUNCTIONS(FIND)
#undef FIND
  return VK_SUCCESS;
}

PFN_vkVoidFunction own(const char* name) {
  if (std::strcmp(name, "vkCreateInstance") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&createInstance);
  if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&createDevice);
#define LOOK(function)                        \
  if (std::strcmp(name, "vk" #function) == 0) \
    return reinterpret_cast<PFN_vkVoidFunction>(&Failing<PFN_vk##function>::Of<k##function>::call);
  FAILING_FUNCTIONS(LOOK)
#undef LOOK
  return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProc(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProc);
  if (auto function = own(name)) return function;
  return nextDeviceProc ? nextDeviceProc(device, name) : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProc(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getInstanceProc);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProc);
  if (auto function = own(name)) return function;
  return nextInstanceProc ? nextInstanceProc(instance, name) : nullptr;
}

}  // namespace

EXPORTED VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* negotiation) {
  negotiation->loaderLayerInterfaceVersion = 2;
  negotiation->pfnGetInstanceProcAddr = &getInstanceProc;
  negotiation->pfnGetDeviceProcAddr = &getDeviceProc;
  negotiation->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
