#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace rill {

/// A shader compiled into the library: its name, the file under shaders/ and the defines it was made from, and its SPIR-V words.
struct EmbeddedShader {
  std::string_view name;
  std::string_view source;
  std::string_view defines;  ///< separated by spaces
  std::span<const uint32_t> words;
};

std::span<const EmbeddedShader> embeddedShaders();

}  // namespace rill
