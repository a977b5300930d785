#pragma once
// Development only (CMake option RILL_SHADER_RELOAD): shaders that change under RILL_SHADER_DIR replace the running ones.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rill {

class DeviceImpl;

class ShaderReload {
 public:
  /// Null where the environment names no folder, or where the library was built without the option.
  static std::unique_ptr<ShaderReload> fromEnvironment();
  explicit ShaderReload(std::string folder);
  /// Recompiles what has changed since the last call. A shader that does not compile keeps its old pipeline; the
  /// compiler's text goes to the device's message callback.
  void poll(DeviceImpl& device);

 private:
  std::string folder_;
  std::vector<int64_t> stamps_;  ///< one an embedded shader: newest time among its source and the shared headers
};

}  // namespace rill
