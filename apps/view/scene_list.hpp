#pragma once
// The scenes to choose from, and which one is open.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "shared/scene_folders.hpp"
#include "view/file_watch.hpp"
#include "view/shown_scene.hpp"

namespace rill::view {

class SceneList {
 public:
  /// `shown` and `message` must outlive it.
  SceneList(apps::SceneFolders folders, ShownScene& shown, MessageBox& message)
      : folders_(std::move(folders)), names_(folders_.names()), shown_(shown), message_(message) {}

  const std::vector<std::string>& names() const { return names_; }
  const std::string& openName() const { return openName_; }

  /// Opens a scene file. Returns all errors; the current scene stays then.
  Expected<void> open(const std::filesystem::path& file, std::vector<Override> changes = {});

  // Errors of these are shown in the message box; those of the device are returned and end the program.
  /// `scene`: a name or a path.
  Expected<void> openNamed(const std::string& scene);
  Expected<void> openDropped(const std::filesystem::path& file);
  /// Opens the scene `step` places further in the list, from -1 to 1.
  Expected<void> openNext(int step);

  /// Shows the error about a scene that is invalid at the start, until the file changes or another scene is opened.
  Expected<void> waitForValidFile(const std::filesystem::path& file, std::vector<Override> changes, const Error& error);
  /// Call in each frame: opens the scene that is waited for if its file has changed. `now_s`: real time.
  Expected<void> openIfChanged(double now_s);
  /// True until a scene is opened after waitForValidFile().
  bool waits() const { return awaited_.has_value(); }

 private:
  struct Awaited {
    FileWatch watch;
    std::vector<Override> changes;
  };

  apps::SceneFolders folders_;
  std::vector<std::string> names_;
  ShownScene& shown_;
  MessageBox& message_;
  std::string openName_;
  std::optional<Awaited> awaited_;
};

}  // namespace rill::view
