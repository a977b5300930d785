#include "gpu/shader_constants.hpp"

#include <algorithm>

#include "gpu/device_impl.hpp"

namespace rill {

Expected<const ComputePipeline*> shaderPipeline(Device& device, std::string_view shader, std::span<const NamedConstant> constants,
                                                SubgroupNeed subgroups) {
  const EmbeddedShader* embedded = embeddedShader(implOf(device), shader);
  if (!embedded) return shaderError(shader, "no embedded shader has this name");
  std::vector<uint32_t> values;
  for (const ShaderConstant& constant : embedded->constants) {
    const auto found = std::ranges::find(constants, constant.name, &NamedConstant::name);
    if (found == constants.end()) return shaderError(shader, "its constant " + std::string(constant.name) + " is given no value");
    values.resize(std::max<size_t>(values.size(), constant.id + 1));
    values[constant.id] = found->value;
  }
  return computePipeline(device,
                         {.shader = shader, .constants = values, .requiredSubgroupSize = subgroups.size, .fullSubgroups = subgroups.full});
}

std::string shaderVariant(const Device& device, std::string_view shader, std::string_view suffix, bool wanted) {
  const std::string variant = std::string(shader) + std::string(suffix);
  return wanted && embeddedShader(implOf(device), variant) ? variant : std::string(shader);
}

}  // namespace rill
