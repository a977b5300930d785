#include "gpu/shader_reload.hpp"

#include <algorithm>
#include <cstdlib>

#include "gpu/device_impl.hpp"
#include "gpu/shader_library.hpp"

namespace rill {
namespace {

[[maybe_unused]] constexpr uint32_t kFramesBetweenPolls = 16;  // a poll takes about 0.2 ms

}  // namespace

std::unique_ptr<ShaderReload> ShaderReload::fromEnvironment() {
#ifdef RILL_SHADER_RELOAD
  if (const char* folder = std::getenv("RILL_SHADER_DIR"); folder && *folder) return std::make_unique<ShaderReload>(folder);
#endif
  return nullptr;
}

ShaderReload::Stamp ShaderReload::newestHeader() const {
  namespace fs = std::filesystem;
  std::error_code failed;  // ignored: a file that an editor is replacing is read at the next poll
  Stamp headers = Stamp::min();
  for (fs::recursive_directory_iterator at(folder_, failed), end; !failed && at != end; at.increment(failed)) {
    const fs::path extension = at->path().extension();
    if (extension != ".h" && extension != ".glsl") continue;
    std::error_code missing;
    if (const Stamp stamp = fs::last_write_time(at->path(), missing); !missing) headers = std::max(headers, stamp);
  }
  return headers;
}

void ShaderReload::poll(DeviceImpl& device) {
#ifdef RILL_SHADER_RELOAD
  if (frames_++ % kFramesBetweenPolls != 0) return;
  const Stamp headers = newestHeader();
  const auto report = [&](const std::string& text) {
    if (device.message) device.message(text);
  };
  const auto reload = [&](const EmbeddedShader& shader) {
    const std::string name(shader.name);
    auto words = compileShader(folder_, shader.source, shader.defines);
    if (!words) return report("shader '" + name + "' does not compile, keeping the old version:\n" + words.error().message);
    if (auto ok = device.pipelines.replace(device, name, *words); !ok) return report("keeping the old version: " + ok.error().message);
    replaced_[name] = std::move(*words);
    report("shader '" + name + "' was reloaded");
  };
  for (const auto& table : device.shaders.tables())
    for (const EmbeddedShader& shader : table) {
      std::error_code missing;
      const Stamp own = std::filesystem::last_write_time(folder_ / shader.source, missing);
      if (missing) continue;  // being replaced, or of a program that keeps its shaders elsewhere
      const Stamp now = std::max(own, headers);
      const auto [known, first] = stamps_.try_emplace(shader.name, now);
      if (first || known->second == now) continue;
      known->second = now;
      reload(shader);
    }
#else
  (void)device;
#endif
}

std::span<const uint32_t> ShaderReload::words(std::string_view name) const {
  const auto found = replaced_.find(name);
  return found == replaced_.end() ? std::span<const uint32_t>() : std::span<const uint32_t>(found->second);
}

}  // namespace rill
