#pragma once
// Specialization constants of embedded shaders by their names in GLSL.
#include <span>
#include <string_view>
#include <vector>

#include "gpu/pipeline.hpp"
#include "rill/device.hpp"

namespace rill {

struct NamedConstant {
  std::string_view name;
  uint32_t value = 0;
};

/// The compute pipeline of an embedded shader. Each of its specialization constants must be among `constants`, which may name others too:
/// a module gives all of its shaders the same list. Fails as computePipeline(), and with Shader for a constant without a value.
Expected<const ComputePipeline*> shaderPipeline(Device& device, std::string_view shader, std::span<const NamedConstant> constants = {},
                                                SubgroupNeed subgroups = {});
inline Expected<const ComputePipeline*> shaderPipeline(Device& device, std::string_view shader,
                                                       std::initializer_list<NamedConstant> constants) {
  return shaderPipeline(device, shader, std::span(constants.begin(), constants.size()));
}

/// `shader`, or if `wanted` its variant, if it has one: `_merged` does more in a pass.
std::string shaderVariant(const Device& device, std::string_view shader, std::string_view suffix, bool wanted);

/// `shader`, or if `texels` its variant that reads arrays through texel buffers, if it has one.
inline std::string texelVariant(const Device& device, std::string_view shader, bool texels) {
  return shaderVariant(device, shader, "_texel", texels);
}

}  // namespace rill
