#include "gpu/shader_reload.hpp"

#include <algorithm>
#include <cstdlib>

#include "gpu/device_impl.hpp"
#include "gpu/shader_library.hpp"

namespace rill {
namespace {

constexpr uint32_t kFramesBetweenLooks = 16;  // a look takes some 0.2 ms

}  // namespace

std::unique_ptr<ShaderReload> ShaderReload::fromEnvironment() {
#ifdef RILL_SHADER_RELOAD
  if (const char* folder = std::getenv("RILL_SHADER_DIR"); folder && *folder) return std::make_unique<ShaderReload>(folder);
#endif
  return nullptr;
}

ShaderReload::ShaderReload(std::filesystem::path folder) : folder_(std::move(folder)), stamps_(look()) {}

std::vector<ShaderReload::Stamp> ShaderReload::look() const {
  namespace fs = std::filesystem;
  std::error_code failed;  // a file that an editor is just replacing is looked at again next time
  Stamp headers = Stamp::min();
  for (fs::recursive_directory_iterator at(folder_, failed), end; !failed && at != end; at.increment(failed)) {
    const fs::path extension = at->path().extension();
    if (extension != ".h" && extension != ".glsl") continue;
    std::error_code gone;
    if (const Stamp stamp = fs::last_write_time(at->path(), gone); !gone) headers = std::max(headers, stamp);
  }
  std::vector<Stamp> stamps;
  for (const EmbeddedShader& shader : embeddedShaders()) {
    std::error_code gone;
    const Stamp own = fs::last_write_time(folder_ / shader.source, gone);
    stamps.push_back(gone ? headers : std::max(own, headers));
  }
  return stamps;
}

void ShaderReload::poll(DeviceImpl& device) {
#ifdef RILL_SHADER_RELOAD
  if (++frames_ % kFramesBetweenLooks != 0) return;
  const std::vector<Stamp> now = look();
  const auto say = [&](std::string text) {
    if (device.message) device.message(text);
  };
  for (size_t i = 0; i < now.size(); ++i) {
    if (now[i] == stamps_[i]) continue;
    const EmbeddedShader& shader = embeddedShaders()[i];
    const std::string name(shader.name);
    auto words = compileShader(folder_, shader.source, shader.defines);
    if (!words) {
      say("shader '" + name + "' does not compile, the old one stays:\n" + words.error().message);
      continue;
    }
    if (auto ok = device.pipelines.replace(device, name, *words); !ok) {
      say("the old one stays: " + ok.error().message);
      continue;
    }
    replaced_[name] = std::move(*words);
    say("shader '" + name + "' was reloaded");
  }
  stamps_ = now;
#else
  (void)device;
#endif
}

std::span<const uint32_t> ShaderReload::words(std::string_view name) const {
  const auto found = replaced_.find(name);
  return found == replaced_.end() ? std::span<const uint32_t>() : std::span<const uint32_t>(found->second);
}

}  // namespace rill
