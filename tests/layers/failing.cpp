// A Vulkan layer that replaces the results of calls, by RILL_TEST_FAIL: a list of FUNCTION CALL RESULT, separated by semicolons.
// "vkQueueSubmit2 3 -4" has the third vkQueueSubmit2 return -4 (VK_ERROR_DEVICE_LOST); with "*" in place of a number every call does.
// An error is returned without the call; a success, such as VK_SUBOPTIMAL_KHR, after it. RILL_TEST_SURFACE_FORMAT=50 leaves windows
// the one format of that number, RILL_TEST_PRESENTS=0 has no queue present to them. With RILL_TEST_PIPELINE_CACHE the driver keeps compiled
// pipelines, and what a cache begins with is printed.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <list>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "layer.hpp"

namespace rill::layer {
namespace {

struct Plan {
  char function[64] = "";
  int call = 0, result = 0;  ///< call 0: every one
  std::atomic<int> calls{0};
};

std::list<Plan> plansOf(const char* text) {
  std::list<Plan> plans;
  std::istringstream list(text ? text : "");
  for (std::string one; std::getline(list, one, ';');) {
    Plan& plan = plans.emplace_back();
    char call[16] = "";
    if (std::sscanf(one.c_str(), "%63s %15s %d", plan.function, call, &plan.result) != 3)
      plans.pop_back();
    else
      plan.call = std::strcmp(call, "*") == 0 ? 0 : std::atoi(call);
  }
  return plans;
}

/// The result that this call of `function` is to return, if any.
std::optional<VkResult> replaced(const char* function) {
  static std::list<Plan> plans = plansOf(std::getenv("RILL_TEST_FAIL"));
  std::optional<VkResult> result;
  for (Plan& plan : plans)
    if (std::strcmp(plan.function, function) == 0)
      if (const int call = ++plan.calls; plan.call == 0 || call == plan.call) result = static_cast<VkResult>(plan.result);
  return result;
}

#define FAILING_FUNCTIONS(X) \
  X(AcquireNextImageKHR)     \
  X(AllocateMemory)          \
  X(CreateBuffer)            \
  X(CreateComputePipelines)  \
  X(CreateShaderModule)      \
  X(CreateSwapchainKHR)      \
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
      const std::optional<VkResult> result = replaced(name);
      if (result && *result < 0) return *result;
      const VkResult done = next(arguments...);
      return result && done == VK_SUCCESS ? *result : done;
    }
  };
};

enum FunctionIndex : int {
#define INDEX(function) k##function,
  FAILING_FUNCTIONS(INDEX)
#undef INDEX
};

PFN_vkGetPhysicalDeviceSurfaceFormatsKHR nextSurfaceFormats = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL surfaceFormats(VkPhysicalDevice device, VkSurfaceKHR surface, uint32_t* count, VkSurfaceFormatKHR* formats) {
  const char* wanted = std::getenv("RILL_TEST_SURFACE_FORMAT");
  if (!wanted) return nextSurfaceFormats(device, surface, count, formats);
  uint32_t offered = 0;
  if (VkResult r = nextSurfaceFormats(device, surface, &offered, nullptr); r != VK_SUCCESS) return r;
  std::vector<VkSurfaceFormatKHR> all(offered);
  if (VkResult r = nextSurfaceFormats(device, surface, &offered, all.data()); r != VK_SUCCESS) return r;
  std::erase_if(all, [&](const VkSurfaceFormatKHR& format) { return format.format != std::atoi(wanted); });
  if (formats) std::copy_n(all.begin(), std::min<size_t>(*count, all.size()), formats);
  *count = static_cast<uint32_t>(all.size());
  return VK_SUCCESS;
}

PFN_vkGetPhysicalDeviceSurfacePresentModesKHR nextPresentModes = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL presentModes(VkPhysicalDevice device, VkSurfaceKHR surface, uint32_t* count, VkPresentModeKHR* modes) {
  const std::optional<VkResult> result = replaced("vkGetPhysicalDeviceSurfacePresentModesKHR");
  return result ? *result : nextPresentModes(device, surface, count, modes);
}

// A driver that keeps compiled pipelines: lavapipe and SwiftShader give no more than a header.
PFN_vkCreatePipelineCache nextCreatePipelineCache = nullptr;
PFN_vkGetPipelineCacheData nextPipelineCacheData = nullptr;
std::atomic<uint64_t> filledCache{0};  // the handle that pipelines were compiled with

VKAPI_ATTR VkResult VKAPI_CALL createPipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                                   const VkAllocationCallbacks* callbacks, VkPipelineCache* cache) {
  std::fprintf(stderr, "initialDataSize=%zu\n", info->initialDataSize);
  VkPipelineCacheCreateInfo empty = *info;  // the driver did not make that data
  empty.initialDataSize = 0;
  return nextCreatePipelineCache(device, &empty, callbacks, cache);
}

VKAPI_ATTR VkResult VKAPI_CALL computePipelines(VkDevice device, VkPipelineCache cache, uint32_t count,
                                                const VkComputePipelineCreateInfo* infos, const VkAllocationCallbacks* callbacks,
                                                VkPipeline* pipelines) {
  if (cache != VK_NULL_HANDLE) filledCache = reinterpret_cast<uint64_t>(cache);
  return Failing<PFN_vkCreateComputePipelines>::Of<kCreateComputePipelines>::call(device, cache, count, infos, callbacks, pipelines);
}

/// What the driver gives, which begins with a header for the device, and 16 bytes if pipelines were compiled with the cache.
VKAPI_ATTR VkResult VKAPI_CALL pipelineCacheData(VkDevice device, VkPipelineCache cache, size_t* size, void* data) {
  size_t driversSize = 0;
  if (VkResult r = nextPipelineCacheData(device, cache, &driversSize, nullptr); r != VK_SUCCESS) return r;
  std::vector<unsigned char> all(driversSize);
  if (VkResult r = nextPipelineCacheData(device, cache, &driversSize, all.data()); r != VK_SUCCESS) return r;
  all.resize(driversSize);
  if (filledCache == reinterpret_cast<uint64_t>(cache)) all.insert(all.end(), 16, 0xA5);
  const bool fits = !data || *size >= all.size();
  if (data && fits) std::ranges::copy(all, static_cast<unsigned char*>(data));
  *size = fits ? all.size() : 0;
  return fits ? VK_SUCCESS : VK_INCOMPLETE;
}

/// In place of the window systems' functions, which take other arguments after the first two.
VKAPI_ATTR VkBool32 VKAPI_CALL presentsNever(VkPhysicalDevice, uint32_t) { return VK_FALSE; }

}  // namespace

void instanceCreated(VkInstance instance) {
  nextSurfaceFormats =
      reinterpret_cast<PFN_vkGetPhysicalDeviceSurfaceFormatsKHR>(nextInstanceProc(instance, "vkGetPhysicalDeviceSurfaceFormatsKHR"));
  nextPresentModes = reinterpret_cast<PFN_vkGetPhysicalDeviceSurfacePresentModesKHR>(
      nextInstanceProc(instance, "vkGetPhysicalDeviceSurfacePresentModesKHR"));
}

void deviceCreated(VkDevice device) {
#define FIND(function)                                               \
  Failing<PFN_vk##function>::Of<k##function>::name = "vk" #function; \
  Failing<PFN_vk##function>::Of<k##function>::next = reinterpret_cast<PFN_vk##function>(nextDeviceProc(device, "vk" #function));
  FAILING_FUNCTIONS(FIND)
#undef FIND
  nextCreatePipelineCache = reinterpret_cast<PFN_vkCreatePipelineCache>(nextDeviceProc(device, "vkCreatePipelineCache"));
  nextPipelineCacheData = reinterpret_cast<PFN_vkGetPipelineCacheData>(nextDeviceProc(device, "vkGetPipelineCacheData"));
}

PFN_vkVoidFunction replacement(const char* name) {
  if (std::strcmp(name, "vkGetPhysicalDeviceSurfaceFormatsKHR") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&surfaceFormats);
  if (std::strcmp(name, "vkGetPhysicalDeviceSurfacePresentModesKHR") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&presentModes);
  if (const char* presents = std::getenv("RILL_TEST_PRESENTS"); presents && std::strcmp(presents, "0") == 0)
    for (const char* function : {"vkGetPhysicalDeviceXcbPresentationSupportKHR", "vkGetPhysicalDeviceXlibPresentationSupportKHR"})
      if (std::strcmp(name, function) == 0) return reinterpret_cast<PFN_vkVoidFunction>(&presentsNever);
  if (std::getenv("RILL_TEST_PIPELINE_CACHE")) {
    if (std::strcmp(name, "vkCreatePipelineCache") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&createPipelineCache);
    if (std::strcmp(name, "vkCreateComputePipelines") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&computePipelines);
    if (std::strcmp(name, "vkGetPipelineCacheData") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&pipelineCacheData);
  }
#define LOOK(function)                        \
  if (std::strcmp(name, "vk" #function) == 0) \
    return reinterpret_cast<PFN_vkVoidFunction>(&Failing<PFN_vk##function>::Of<k##function>::call);
  FAILING_FUNCTIONS(LOOK)
#undef LOOK
  return nullptr;
}

}  // namespace rill::layer
