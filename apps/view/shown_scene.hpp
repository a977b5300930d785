#pragma once
// The scene in the window: its session, with what depends on how it is watched: playback, camera, image, edits.
#include <filesystem>
#include <memory>
#include <vector>

#include "view/controls.hpp"
#include "view/graphics.hpp"
#include "view/gravity_tilt.hpp"
#include "view/held_edit.hpp"
#include "view/interface.hpp"
#include "view/message_box.hpp"
#include "view/picture.hpp"
#include "view/playback.hpp"
#include "view/settings.hpp"
#include "view/snapshot_timer.hpp"

namespace rill::view {

/// Where nothing else is said, errors are shown in the message box; those of the device are returned and end the program.
class ShownScene {
 public:
  /// All must outlive it.
  ShownScene(const Window& window, const Interface& interface, Graphics& graphics, Settings& settings, MessageBox& message, bool lockstep)
      : window_(window), interface_(interface), graphics_(graphics), settings_(settings), message_(message), lockstep_(lockstep) {}

  /// Opens a scene file and shows its warnings. Returns all errors; the current scene stays then.
  Expected<void> open(const std::filesystem::path& file, std::vector<Override> changes);
  Expected<void> restart();
  /// Reads the file again if it has changed. Where it is invalid the current scene continues.
  Expected<void> reloadIfChanged(double now_s);
  Expected<void> change(const Override& change);
  Expected<void> reset(const std::string& key);  ///< to the value of the file
  /// Tilts gravity, as seen by the camera.
  Expected<void> tilt(Tilt direction);
  /// Throws fluid at what is under the pointer.
  Expected<void> throwFluid();
  Expected<void> throwCrate();  ///< likewise
  /// Pours fluid above what is under the pointer, until closeTap().
  Expected<void> openTap();
  void closeTap() {
    if (session_) controls_.closeTap(*session_);
  }
  /// Changes the density of a body, kg/m^3.
  Expected<void> changeDensity(uint32_t solid, double density);
  void pauseAfterOneStep();

  /// Handles an event of the pointer, a button or the wheel. `overPanels`: the pointer is over a panel.
  Expected<void> handle(const InputEvent& event, bool overPanels);
  /// Arranges the window; where the image's area changes, the camera is framed again.
  void layOut(Window::Size size);
  /// Simulates for a displayed frame, about as long as the image takes to render, so that the window stays responsive.
  Expected<void> simulate(double seconds, double now_s);
  /// Draws the image where something has changed.
  Expected<void> paint(double seconds);
  /// True where nothing will change without input or simulation.
  bool still() const { return !dirty_ && !controls_.camera.moving(); }

  /// Frees all on the device, which may be lost; see Session.
  void release();
  Expected<void> resume() { return session_->resume(); }

  Session& session() { return *session_; }
  OrbitCamera& camera() { return controls_.camera; }
  const Layout& layout() const { return layout_; }
  /// As Controls::pullLine().
  std::optional<std::array<Place, 2>> pullLine() const { return controls_.pullLine(*session_, layout_.picture); }
  const Picture& picture() const { return picture_; }
  Playback& playback() { return playback_; }
  HeldEdit& heldEdit() { return held_; }

 private:
  CameraView homeView() const;
  std::string pouredFluid() const;  // empty: the first of the scene
  Expected<void> applied(const Expected<void>& change, const std::string& key);
  void onRestart();

  const Window& window_;
  const Interface& interface_;
  Graphics& graphics_;
  Settings& settings_;
  MessageBox& message_;
  const bool lockstep_;

  std::unique_ptr<Session> session_;
  Layout layout_;
  Controls controls_;
  Playback playback_;
  Picture picture_;
  HeldEdit held_;
  SnapshotTimer snapshots_;
  bool dirty_ = true;  // the image must be drawn again
};

}  // namespace rill::view
