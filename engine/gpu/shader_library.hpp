#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rill/pipeline.hpp"

namespace rill {

/// A binding of a shader, reflected from its SPIR-V.
struct ShaderBinding {
  std::string_view name;  ///< of the buffer's first member, the texel buffer or the image in GLSL; empty: used by another stage
  BindingKind kind = BindingKind::Storage;
  bool writes = false;  ///< not declared `readonly`
};

struct ShaderConstant {
  std::string_view name;
  uint32_t id = 0;  ///< its constant_id
};

/// A shader compiled into the library: its name, the file under shaders/ and the defines it was made from, its SPIR-V words and what they
/// declare (cmake/embed_shader.cmake).
struct EmbeddedShader {
  std::string_view name;
  std::string_view source;
  std::string_view defines;  ///< separated by spaces
  std::span<const uint32_t> words;
  std::span<const ShaderBinding> bindings;  ///< element k is binding k
  std::span<const ShaderConstant> constants;
  uint32_t pushConstantBytes = 0;
};

std::span<const EmbeddedShader> embeddedShaders();

/// Null if `table` has none of this name.
inline const EmbeddedShader* findShader(std::span<const EmbeddedShader> table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &EmbeddedShader::name);
  return found == table.end() ? nullptr : &*found;
}

/// The tables in which a device looks up shaders: those of the engine and of additional modules.
class ShaderLibrary {
 public:
  void add(std::span<const EmbeddedShader> table) {
    for (const auto& known : tables_)
      if (known.data() == table.data()) return;
    tables_.push_back(table);
  }
  const std::vector<std::span<const EmbeddedShader>>& tables() const { return tables_; }

 private:
  std::vector<std::span<const EmbeddedShader>> tables_{embeddedShaders()};
};

}  // namespace rill
