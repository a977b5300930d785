#pragma once
// What the mouse, keys and dropped files do.
#include <filesystem>
#include <optional>
#include <utility>

#include "view/input.hpp"
#include "view/interface.hpp"
#include "view/keys.hpp"
#include "view/scene_list.hpp"
#include "view/settings.hpp"
#include "view/shown_scene.hpp"

namespace rill::view {

class InputHandler {
 public:
  /// All must outlive it.
  InputHandler(Settings& settings, Interface& interface, ShownScene& shown, SceneList& scenes)
      : settings_(settings), interface_(interface), shown_(shown), scenes_(scenes) {}

  /// Handles an event that the panels do not use. Returns errors that end the program.
  Expected<void> handle(const InputEvent& event);
  /// The file for a screenshot of this frame, where a key asked for one; returned once.
  std::optional<std::filesystem::path> takeScreenshot() { return std::exchange(screenshot_, std::nullopt); }

 private:
  Expected<void> perform(Action action, bool shift);

  Settings& settings_;
  Interface& interface_;
  ShownScene& shown_;
  SceneList& scenes_;
  std::optional<std::filesystem::path> screenshot_;
};

}  // namespace rill::view
