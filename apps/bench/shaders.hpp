#pragma once
#include <algorithm>
#include <string_view>

#include "gpu/shader_library.hpp"

namespace rill {

/// Those of the bench's own.
std::span<const EmbeddedShader> benchShaders();

namespace bench {

/// SPIR-V of apps/bench/shaders; `name` is one of them.
inline std::span<const uint32_t> benchShader(std::string_view name) {
  return std::ranges::find(benchShaders(), name, &EmbeddedShader::name)->words;
}

}  // namespace bench
}  // namespace rill
