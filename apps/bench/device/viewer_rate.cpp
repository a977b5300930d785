#include "bench/device/viewer_rate.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <system_error>

#include "shared/piped_process.hpp"
#include "shared/words.hpp"

namespace rill::bench {
namespace {

namespace fs = std::filesystem;

bool isSet(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

/// Beside this program as installed, in the folder of a build, or in PATH.
std::optional<fs::path> viewerProgram() {
  std::error_code error;
  const fs::path own = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (!error)
    for (const fs::path& place : {own / "rill-view", own / "../view/rill-view"})
      if (std::error_code absent; fs::is_regular_file(place, absent)) return place;
  return apps::findProgram("rill-view");
}

}  // namespace

ViewerRate viewerRate(const Bench& bench, const std::string& scene, uint32_t frames) {
  ViewerRate rate;
  if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY")) {
    rate.leftOut = "no display: neither DISPLAY nor WAYLAND_DISPLAY is set";
    return rate;
  }
  const auto program = viewerProgram();
  if (!program) {
    rate.leftOut = "rill-view is neither beside rill-bench nor in PATH";
    return rate;
  }
  std::string command = apps::shellQuoted(program->string()) + " " + scene + " --frames " + std::to_string(frames);
  if (!bench.options().device.name.empty()) command += " --device " + apps::shellQuoted(bench.options().device.name);
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::string output;
  char part[512];
  while (pipe && std::fgets(part, sizeof part, pipe)) output += part;
  const int status = pipe ? ::pclose(pipe) : -1;
  std::istringstream lines(output);
  std::string key, last;
  for (std::string line; std::getline(lines, line); last = line) {
    std::istringstream words(line);
    words >> key;
    if (key == "frame_ms") words >> rate.frame_ms;
    if (key == "frame_ms_p95") words >> rate.frame_p95_ms;
  }
  if (status != 0 || rate.frame_ms <= 0) rate.leftOut = "rill-view failed: " + last;
  return rate;
}

}  // namespace rill::bench
