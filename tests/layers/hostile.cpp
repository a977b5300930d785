// A Vulkan layer that makes any driver a hostile one, by what the specification leaves to drivers. RILL_TEST_HOSTILE names it, separated
// by commas: flush-denormals, assume-finite, perturb=SEED, poison-shuffles, groups=SEED rewrite shaders (spirv_rewrites.hpp);
// varying-subgroups=SIZE reports that no subgroup size can be required and that subgroups may be as small as SIZE. gpu-assisted is not
// hostile: it works around two faults of the packaged validation layer, see splitLoopHeaders in spirv_rewrites.hpp.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <spirv-tools/libspirv.hpp>
#include <string>
#include <string_view>

#include "layer.hpp"
#include "spirv_rewrites.hpp"

namespace rill::layer {
namespace {

PFN_vkCreateShaderModule nextCreateShaderModule = nullptr;
PFN_vkGetPhysicalDeviceProperties2 nextGetProperties = nullptr;
PFN_vkWaitSemaphores nextWaitSemaphores = nullptr;
PFN_vkDeviceWaitIdle nextDeviceWaitIdle = nullptr;
PFN_vkGetSemaphoreCounterValue nextGetCounter = nullptr;
PFN_vkQueueSubmit2 nextQueueSubmit2 = nullptr;

struct Behavior {
  std::string name;
  uint32_t number = 0;
};

std::vector<Behavior> behaviors() {
  const char* given = std::getenv("RILL_TEST_HOSTILE");
  std::vector<Behavior> out;
  for (std::string_view todo = given ? given : ""; !todo.empty();) {
    const std::string_view one = todo.substr(0, todo.find(','));
    todo.remove_prefix(std::min(one.size() + 1, todo.size()));
    const size_t equals = std::min(one.find('='), one.size());
    const std::string number(one.substr(std::min(equals + 1, one.size())));
    out.push_back({std::string(one.substr(0, equals)), static_cast<uint32_t>(std::strtoul(number.c_str(), nullptr, 10))});
  }
  return out;
}

std::vector<uint32_t> rewritten(std::vector<uint32_t> words) {
  for (const auto& [name, seed] : behaviors()) {
    if (name == "flush-denormals") {
      words = flushDenormals(words);
    } else if (name == "assume-finite") {
      words = assumeFinite(words);
    } else if (name == "perturb") {
      words = perturbRounding(words, seed);
    } else if (name == "poison-shuffles") {
      words = poisonShuffles(words);
    } else if (name == "groups") {
      words = permuteWorkgroups(words, seed);
    } else if (name == "gpu-assisted") {
      words = splitLoopHeaders(words);
    } else if (name != "varying-subgroups") {
      std::fprintf(stderr, "RILL_TEST_HOSTILE: unknown name \"%s\"\n", name.c_str());
      std::abort();
    }
  }
  return words;
}

/// Ends the program if the module is not valid SPIR-V for Vulkan 1.3.
void requireValid(const std::vector<uint32_t>& words) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
  tools.SetMessageConsumer([](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
    std::fprintf(stderr, "RILL_TEST_HOSTILE: a rewritten shader is not valid: %s\n", message);
  });
  if (!tools.Validate(words)) std::abort();
}

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks* callbacks, VkShaderModule* module) {
  const std::vector<uint32_t> words = rewritten({info->pCode, info->pCode + info->codeSize / 4});
  requireValid(words);
  VkShaderModuleCreateInfo changed = *info;
  changed.codeSize = words.size() * 4;
  changed.pCode = words.data();
  return nextCreateShaderModule(device, &changed, callbacks, module);
}

VKAPI_ATTR void VKAPI_CALL getProperties(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* out) {
  nextGetProperties(physical, out);
  for (const auto& [name, size] : behaviors())
    for (auto* next = static_cast<VkBaseOutStructure*>(out->pNext); next && name == "varying-subgroups"; next = next->pNext)
      if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES) {
        auto& sizes = *reinterpret_cast<VkPhysicalDeviceSubgroupSizeControlProperties*>(next);
        sizes.minSubgroupSize = size;
        sizes.requiredSubgroupSizeStages = 0;
      }
}

bool isGpuAssisted() {
  const auto all = behaviors();
  return std::ranges::any_of(all, [](const Behavior& one) { return one.name == "gpu-assisted"; });
}

// Gpu-assisted validation of 1.3.239 holds a lock while it waits for a semaphore's state, which its own thread needs to change it, and
// goes on after ten seconds. So it sees no question about semaphores: the whole device is waited for, and then all signals have come.
std::map<VkSemaphore, uint64_t> signals;

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* submits, VkFence fence) {
  for (uint32_t k = 0; k < count; ++k)
    for (uint32_t s = 0; s < submits[k].signalSemaphoreInfoCount; ++s)
      signals[submits[k].pSignalSemaphoreInfos[s].semaphore] = submits[k].pSignalSemaphoreInfos[s].value;
  return nextQueueSubmit2(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL waitSemaphores(VkDevice device, const VkSemaphoreWaitInfo* info, uint64_t timeout) {
  return isGpuAssisted() ? nextDeviceWaitIdle(device) : nextWaitSemaphores(device, info, timeout);
}

VKAPI_ATTR VkResult VKAPI_CALL getCounter(VkDevice device, VkSemaphore semaphore, uint64_t* value) {
  if (!isGpuAssisted()) return nextGetCounter(device, semaphore, value);
  *value = signals[semaphore];
  return nextDeviceWaitIdle(device);
}

}  // namespace

void instanceCreated(VkInstance instance) {
  nextGetProperties = reinterpret_cast<PFN_vkGetPhysicalDeviceProperties2>(nextInstanceProc(instance, "vkGetPhysicalDeviceProperties2"));
}

void deviceCreated(VkDevice device) {
  nextCreateShaderModule = reinterpret_cast<PFN_vkCreateShaderModule>(nextDeviceProc(device, "vkCreateShaderModule"));
  nextWaitSemaphores = reinterpret_cast<PFN_vkWaitSemaphores>(nextDeviceProc(device, "vkWaitSemaphores"));
  nextDeviceWaitIdle = reinterpret_cast<PFN_vkDeviceWaitIdle>(nextDeviceProc(device, "vkDeviceWaitIdle"));
  nextGetCounter = reinterpret_cast<PFN_vkGetSemaphoreCounterValue>(nextDeviceProc(device, "vkGetSemaphoreCounterValue"));
  nextQueueSubmit2 = reinterpret_cast<PFN_vkQueueSubmit2>(nextDeviceProc(device, "vkQueueSubmit2"));
}

PFN_vkVoidFunction replacement(const char* name) {
  if (std::strcmp(name, "vkCreateShaderModule") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&createShaderModule);
  if (std::strcmp(name, "vkWaitSemaphores") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&waitSemaphores);
  if (std::strcmp(name, "vkGetSemaphoreCounterValue") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getCounter);
  if (std::strcmp(name, "vkQueueSubmit2") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&queueSubmit2);
  if (std::strcmp(name, "vkGetPhysicalDeviceProperties2") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&getProperties);
  return nullptr;
}

}  // namespace rill::layer
