#pragma once
// Development only (CMake option RILL_SHADER_RELOAD): recompiles shaders that change under RILL_SHADER_DIR.
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
  /// Null if RILL_SHADER_DIR is not set or the library was built without the option.
  static std::unique_ptr<ShaderReload> fromEnvironment();
  explicit ShaderReload(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// Every few frames, recompiles the shaders that changed. A shader that fails to compile keeps its old
  /// version. Successes and failures go to the device's message callback.
  void poll(DeviceImpl& device);
  /// The reloaded SPIR-V of `name`; empty if it has not changed.
  std::span<const uint32_t> words(std::string_view name) const;

 private:
  using Stamp = std::filesystem::file_time_type;
  Stamp newestHeader() const;

  std::filesystem::path folder_;
  std::map<std::string_view, Stamp> stamps_;  ///< shader name -> newest time of its source and all headers
  std::map<std::string, std::vector<uint32_t>, std::less<>> replaced_;
  [[maybe_unused]] uint32_t frames_ = 0;  ///< only used with RILL_SHADER_RELOAD
};

/// Compiles a shader of `folder` with glslang. The error message is the compiler's log.
Expected<std::vector<uint32_t>> compileShader(const std::filesystem::path& folder, std::string_view source, std::string_view defines);

}  // namespace rill
