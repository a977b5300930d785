#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace rill {

/// A shader compiled into the library: its name, the file under shaders/ and the defines it was made from, and its SPIR-V words.
struct EmbeddedShader {
  std::string_view name;
  std::string_view source;
  std::string_view defines;  ///< separated by spaces
  std::span<const uint32_t> words;
};

std::span<const EmbeddedShader> embeddedShaders();

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
