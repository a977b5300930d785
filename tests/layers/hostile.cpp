// A Vulkan layer that makes any driver a hostile one: it rewrites shaders as the specification allows (spirv_rewrites.hpp).
// RILL_TEST_HOSTILE names what it does, separated by commas: flush-denormals, assume-finite, perturb=SEED, poison-shuffles, groups=SEED.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "layer.hpp"
#include "spirv_rewrites.hpp"

namespace rill::layer {
namespace {

PFN_vkCreateShaderModule nextCreateShaderModule = nullptr;

std::vector<uint32_t> rewritten(std::vector<uint32_t> words, std::string_view todo) {
  while (!todo.empty()) {
    const std::string_view one = todo.substr(0, todo.find(','));
    todo.remove_prefix(std::min(one.size() + 1, todo.size()));
    const size_t equals = one.find('=');
    const std::string_view name = one.substr(0, equals);
    const auto seed =
        equals == one.npos ? 0u : static_cast<uint32_t>(std::strtoul(std::string(one.substr(equals + 1)).c_str(), nullptr, 10));
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
    } else {
      std::fprintf(stderr, "RILL_TEST_HOSTILE: unknown name \"%s\"\n", std::string(name).c_str());
      std::abort();
    }
  }
  return words;
}

VKAPI_ATTR VkResult VKAPI_CALL createShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks* callbacks, VkShaderModule* module) {
  const char* todo = std::getenv("RILL_TEST_HOSTILE");
  const std::vector<uint32_t> words = rewritten({info->pCode, info->pCode + info->codeSize / 4}, todo ? todo : "");
  VkShaderModuleCreateInfo changed = *info;
  changed.codeSize = words.size() * 4;
  changed.pCode = words.data();
  return nextCreateShaderModule(device, &changed, callbacks, module);
}

}  // namespace

void deviceCreated(VkDevice device) {
  nextCreateShaderModule = reinterpret_cast<PFN_vkCreateShaderModule>(nextDeviceProc(device, "vkCreateShaderModule"));
}

PFN_vkVoidFunction replacement(const char* name) {
  return std::strcmp(name, "vkCreateShaderModule") == 0 ? reinterpret_cast<PFN_vkVoidFunction>(&createShaderModule) : nullptr;
}

}  // namespace rill::layer
