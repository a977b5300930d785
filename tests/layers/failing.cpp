// A Vulkan layer that makes one call fail: RILL_TEST_FAIL="vkQueueSubmit2 3 -4" has the third vkQueueSubmit2 return -4
// (VK_ERROR_DEVICE_LOST).
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "layer.hpp"

namespace rill::layer {
namespace {

struct Plan {
  char function[64] = "";
  int call = 0, result = 0;
  Plan() {
    if (const char* text = std::getenv("RILL_TEST_FAIL"); text && std::sscanf(text, "%63s %d %d", function, &call, &result) != 3) call = 0;
  }
};

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

}  // namespace

void instanceCreated(VkInstance) {}

void deviceCreated(VkDevice device) {
#define FIND(function)                                               \
  Failing<PFN_vk##function>::Of<k##function>::name = "vk" #function; \
  Failing<PFN_vk##function>::Of<k##function>::next = reinterpret_cast<PFN_vk##function>(nextDeviceProc(device, "vk" #function));
  FAILING_FUNCTIONS(FIND)
#undef FIND
}

PFN_vkVoidFunction replacement(const char* name) {
#define LOOK(function)                        \
  if (std::strcmp(name, "vk" #function) == 0) \
    return reinterpret_cast<PFN_vkVoidFunction>(&Failing<PFN_vk##function>::Of<k##function>::call);
  FAILING_FUNCTIONS(LOOK)
#undef LOOK
  return nullptr;
}

}  // namespace rill::layer
