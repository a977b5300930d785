#include "gpu/reconvergence.hpp"

#include <cstring>
#include <string_view>

#include "gpu/spirv.hpp"

namespace rill {
namespace {

using namespace spirv;

// Execution modes of SPV_KHR_subgroup_uniform_control_flow and SPV_KHR_maximal_reconvergence.
constexpr uint32_t kSubgroupUniformControlFlow = 4421, kMaximallyReconverges = 6023;

std::vector<uint32_t> extension(std::string_view name) {
  std::vector<uint32_t> words(1 + name.size() / 4 + 1);  // with a null at its end
  words[0] = uint32_t(words.size()) << 16 | kOpExtension;
  std::memcpy(&words[1], name.data(), name.size());
  return words;
}

}  // namespace

Reconvergence reconvergenceOf(const VkPhysicalDeviceFeatures2& enabled) {
  Reconvergence found = Reconvergence::Workgroup;
  for (auto* next = static_cast<const VkBaseInStructure*>(enabled.pNext); next; next = next->pNext) {
    if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_MAXIMAL_RECONVERGENCE_FEATURES_KHR) {
      if (reinterpret_cast<const VkPhysicalDeviceShaderMaximalReconvergenceFeaturesKHR*>(next)->shaderMaximalReconvergence)
        return Reconvergence::Maximal;
    } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_SUBGROUP_UNIFORM_CONTROL_FLOW_FEATURES_KHR) {
      if (reinterpret_cast<const VkPhysicalDeviceShaderSubgroupUniformControlFlowFeaturesKHR*>(next)->shaderSubgroupUniformControlFlow)
        found = Reconvergence::Subgroup;
    }
  }
  return found;
}

std::vector<uint32_t> withReconvergence(std::span<const uint32_t> words, Reconvergence wanted) {
  std::vector<uint32_t> out(words.begin(), words.end());
  if (wanted == Reconvergence::Workgroup) return out;
  const bool isMaximal = wanted == Reconvergence::Maximal;
  size_t extensions = 0, modes = 0;  // where they belong: behind the capabilities and extensions, behind the entry points
  std::vector<uint32_t> added;
  forEachDeclaration(words, [&](uint32_t op, std::span<const uint32_t> instruction) {
    const size_t end = size_t(instruction.data() - words.data()) + instruction.size();
    if (op == kOpCapability || op == kOpExtension) extensions = end;
    if (op != kOpEntryPoint || instruction.size() < 3) return;
    modes = end;
    added.insert(added.end(),
                 {3u << 16 | kOpExecutionMode, instruction[2], isMaximal ? kMaximallyReconverges : kSubgroupUniformControlFlow});
  });
  if (extensions == 0 || modes < extensions) return out;  // invalid, which the driver finds
  out.insert(out.begin() + std::ptrdiff_t(modes), added.begin(), added.end());
  const std::vector<uint32_t> name = extension(isMaximal ? "SPV_KHR_maximal_reconvergence" : "SPV_KHR_subgroup_uniform_control_flow");
  out.insert(out.begin() + std::ptrdiff_t(extensions), name.begin(), name.end());
  return out;
}

}  // namespace rill
