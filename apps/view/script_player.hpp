#pragma once
// Executes the lines of a script in the frames that they name.
#include <filesystem>
#include <optional>
#include <vector>

#include "shared/scene_folders.hpp"
#include "view/scene_list.hpp"
#include "view/script.hpp"
#include "view/settings.hpp"
#include "view/shown_scene.hpp"
#include "view/window.hpp"

namespace rill::view {

/// Checks the names of scenes and views in a script. BadInput with the first that is unknown.
Expected<void> checkNames(const std::vector<ScriptLine>& lines, const apps::SceneFolders& folders);

class ScriptPlayer {
 public:
  /// What the script asks of a frame beyond what is done at once.
  struct Frame {
    std::vector<InputEvent> events;
    std::optional<std::filesystem::path> screenshot;
  };

  /// References must stay valid.
  ScriptPlayer(std::vector<ScriptLine> lines, Window& window, Settings& settings, ShownScene& shown, SceneList& scenes)
      : lines_(std::move(lines)), window_(window), settings_(settings), shown_(shown), scenes_(scenes) {}

  /// Executes the lines up to displayed frame `frame`. Returns errors that end the program.
  Expected<Frame> play(uint64_t frame);
  bool empty() const { return lines_.empty(); }
  /// True after the last line was executed.
  bool ended() const { return next_ == lines_.size(); }

 private:
  std::vector<ScriptLine> lines_;
  size_t next_ = 0;
  Window& window_;
  Settings& settings_;
  ShownScene& shown_;
  SceneList& scenes_;
};

}  // namespace rill::view
