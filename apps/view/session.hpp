#pragma once
// The scene that is shown: its file, the changes made to it, its running simulation and the pictures of it.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "offline/painter.hpp"
#include "view/file_watch.hpp"
#include "view/runner.hpp"

namespace rill::view {

class Session {
 public:
  /// Reads, judges and starts a scene; errors as loadScene() and Fluid::create(). The context outlives it.
  static Expected<std::unique_ptr<Session>> open(offline::Context& context, const std::filesystem::path& file,
                                                 std::vector<Override> changes = {});

  /// Whether a key can change while the scene goes on; others begin it anew.
  bool isLive(std::string_view key) const;
  /// Sets a key of the scene, as --set of rill-capture does. After an error nothing has changed.
  Expected<void> change(const Override& change);
  /// Back to what the file says.
  Expected<void> reset(std::string_view key);
  bool isChanged(std::string_view key) const;
  const std::vector<Override>& changes() const { return changes_; }
  /// The file's scene with the changes, as JSON; comments are lost. Files that it names are found from `folder` too.
  Expected<std::string> text(const std::filesystem::path& folder) const;

  /// As Runner's, and pictures follow. What hands did to the fluid is not part of the file's scene: restart() forgets it, text() leaves it
  /// out.
  Expected<void> changeSolids(std::vector<Solid> solids);
  Expected<uint64_t> add(const Fill& fill);

  /// From the start, with the changes.
  Expected<void> restart();
  /// The same of what the file says now. A broken file leaves the scene as it was, and what is done to it goes on from the text before.
  Expected<void> reload();
  /// Whether the file is another than the one that was read (asked at most twice a second of `now_s`).
  bool fileChanged(double now_s) { return watch_.changed(now_s); }
  const std::filesystem::path& file() const { return watch_.file(); }

  Runner& runner() { return *runner_; }
  const Runner& runner() const { return *runner_; }
  const Scene& scene() const { return runner_->scene(); }
  offline::Painter& painter() { return *painter_; }
  CameraView camera(double aspect) const { return sceneCamera(scene(), runner_->start(), aspect); }

 private:
  Session(offline::Context& context, std::filesystem::path file) : context_(context), watch_(std::move(file)) {}
  Expected<Scene> parse(std::string_view text, std::span<const Override> changes) const;
  Expected<void> read(std::vector<Override> changes);
  Expected<void> begin(std::string_view text, std::vector<Override> changes);
  Expected<void> apply(std::vector<Override> changes, bool live);
  void paintAnew();

  offline::Context& context_;
  FileWatch watch_;
  std::string text_;  ///< of the file, as it was read
  std::vector<Override> changes_;
  std::unique_ptr<Runner> runner_;
  std::unique_ptr<offline::Painter> painter_;  // refers to the runner's scene
};

}  // namespace rill::view
