#pragma once
// Input scripts for rill-view: for tests and for reproducible bug reports.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rill/scene_io.hpp"
#include "view/input.hpp"

namespace rill::view {

struct ScriptLine {
  enum class Kind { Input, Set, Scene, View, Resize, Minimize, Restore, Screenshot };
  uint64_t frame = 0;  ///< displayed frame, from 0
  Kind kind = Kind::Input;
  InputEvent input;
  Override change;
  std::string name;                ///< of a scene, a view, a file
  uint32_t width = 0, height = 0;  ///< of Resize, pixels
};

/// One command per line, "FRAME COMMAND ...", in order of frames; '#' starts a comment. BadInput as "name:line: ...".
Expected<std::vector<ScriptLine>> parseScript(std::string_view text, std::string_view name);
Expected<std::vector<ScriptLine>> loadScript(const std::filesystem::path& file);

/// Help on all commands, one per line.
std::string scriptHelp();

}  // namespace rill::view
