#pragma once
#include "gpu/shader_library.hpp"

namespace rill {

/// Shaders of apps/bench/shaders.
std::span<const EmbeddedShader> benchShaders();

}  // namespace rill
