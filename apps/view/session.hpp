#pragma once
// The open scene: its file, changes made to it, the simulation and the renderer.
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
  /// Reads, validates and starts a scene; errors as loadScene() and Fluid::create(). The context outlives it.
  static Expected<std::unique_ptr<Session>> open(offline::Context& context, const std::filesystem::path& file,
                                                 std::vector<Override> changes = {});

  /// True for keys that can change while the simulation continues; others restart it.
  bool isLive(std::string_view key) const;
  /// Overrides a key of the scene like --set. After an error nothing is changed.
  Expected<void> change(const Override& change);
  /// Restores the value of the file.
  Expected<void> reset(std::string_view key);
  bool isChanged(std::string_view key) const;
  const std::vector<Override>& changes() const { return changes_; }
  /// The scene with its changes, as JSON without comments. Paths in it are relative to `folder`.
  Expected<std::string> text(const std::filesystem::path& folder) const;

  /// Changes the density of a body (kg/m^3) while the simulation continues: its key, or of one that was added its solid.
  Expected<void> changeDensity(uint32_t solid, double density);

  /// As in Runner. These changes are not part of the scene file: restart() drops them and text() omits them.
  Expected<void> changeSolids(std::vector<Solid> solids);
  Expected<uint64_t> add(const Fill& fill);
  Expected<void> addTap(const Emitter& emitter, uint64_t room);
  Expected<void> changeTap(const std::string& fluid);

  /// Restarts with the changes.
  Expected<void> restart();
  /// Reads the file again and restarts. Where it is invalid the scene and its text stay as they are.
  Expected<void> reload();
  /// As Runner::keep(), for resume().
  Expected<void> keep(uint32_t particles = UINT32_MAX) { return runner_->keep(particles); }
  /// Frees all on the device, which may be lost. Until resume() only that and file() may be called.
  void release();
  /// Continues on the context's new device from the last snapshot, else from the start. May be called again after an error.
  Expected<void> resume();

  /// True where the file was modified since it was read; checked at most twice per second of `now_s`.
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
  void resetPainter();

  offline::Context& context_;
  FileWatch watch_;
  std::string text_;  ///< of the file, as it was read
  std::vector<Override> changes_;
  size_t fileSolids_ = 0;  ///< solids of the file; those behind them were added
  std::unique_ptr<Runner> runner_;
  KeptState released_;                         ///< from release() to resume()
  std::unique_ptr<offline::Painter> painter_;  // refers to the runner's scene
};

}  // namespace rill::view
