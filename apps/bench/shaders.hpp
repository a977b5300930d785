#pragma once
#include <algorithm>
#include <string_view>

#include "gpu/shader_library.hpp"

namespace rill {

/// Shaders of apps/bench/shaders.
std::span<const EmbeddedShader> benchShaders();

namespace bench {

/// SPIR-V of the shader `name`, which must exist.
inline std::span<const uint32_t> benchShader(std::string_view name) {
  return std::ranges::find(benchShaders(), name, &EmbeddedShader::name)->words;
}

}  // namespace bench
}  // namespace rill
