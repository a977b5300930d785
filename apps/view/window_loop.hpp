#pragma once
// Frame after frame: takes input, simulates, draws the image and the panels, carries out what they request.
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "shared/scene_folders.hpp"
#include "view/device_change.hpp"
#include "view/graphics.hpp"
#include "view/input_handler.hpp"
#include "view/interface.hpp"
#include "view/message_box.hpp"
#include "view/options.hpp"
#include "view/run_summary.hpp"
#include "view/scene_list.hpp"
#include "view/script_player.hpp"
#include "view/settings.hpp"
#include "view/shown_scene.hpp"
#include "view/window.hpp"

namespace rill::view {

class WindowLoop {
 public:
  /// `options` must outlive it.
  WindowLoop(const Options& options, std::unique_ptr<Window> window, const apps::SceneFolders& folders, std::vector<ScriptLine> script);

  /// Opens the device and a scene file. `valid`: whether that can be read; if not, its error is shown until it is valid.
  Expected<void> open(const std::filesystem::path& file, const Expected<void>& valid);
  /// Runs until the window is closed, the last frame of --frames or a script, or a signal. Then prints the summary of a run with
  /// --frames or a script.
  Expected<void> run();

  bool sawValidationMessage() const { return graphics_.sawValidationMessage(); }
  /// True where the requested scene was never valid, and no other one was opened.
  bool waitsForScene() const { return scenes_.waits(); }

 private:
  bool isBounded() const { return options_.frames || !script_.empty(); }
  bool isLastFrame() const;
  Expected<void> frame(double seconds);
  Expected<void> draw(const std::optional<std::filesystem::path>& screenshot);
  Expected<void> show(const ImDrawData& lists, const std::optional<std::filesystem::path>& screenshot);

  const Options& options_;
  // In the order of their dependencies.
  std::unique_ptr<Window> window_;
  Interface interface_;
  Settings settings_;
  MessageBox message_;
  Graphics graphics_;
  ShownScene shown_;
  SceneList scenes_;
  DeviceChange devices_;
  InputHandler input_;
  ScriptPlayer script_;
  RunSummary summary_;

  uint64_t frame_ = 0;
  double now_s_ = 0, frameTime_s_ = 0;  // real time; of a displayed frame, smoothed
};

}  // namespace rill::view
