#pragma once
// Development only (CMake option RILL_SHADER_RELOAD): shaders that change under RILL_SHADER_DIR replace the running ones.
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rill/expected.hpp"

namespace rill {

class DeviceImpl;

class ShaderReload {
 public:
  /// Null where the environment names no folder, or where the library was built without the option.
  static std::unique_ptr<ShaderReload> fromEnvironment();
  explicit ShaderReload(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Recompiles what has changed since the last look, which is taken every few frames. A shader that does not compile
  /// keeps its old version; that, and every success, is told to the device's message callback.
  void poll(DeviceImpl& device);
  /// The words that replace the embedded ones of `name`; empty where it has not changed.
  std::span<const uint32_t> words(std::string_view name) const;

 private:
  using Stamp = std::filesystem::file_time_type;
  Stamp newestHeader() const;

  std::filesystem::path folder_;
  std::map<std::string_view, Stamp> stamps_;  ///< by a shader's name: the newest among its source and all headers
  std::map<std::string, std::vector<uint32_t>, std::less<>> replaced_;
  [[maybe_unused]] uint32_t frames_ = 0;  ///< counted where the library reloads
};

/// Compiles a compute shader of `folder` with glslang. The error is the compiler's text.
Expected<std::vector<uint32_t>> compileShader(const std::filesystem::path& folder, std::string_view source, std::string_view defines);

}  // namespace rill
