#pragma once
// Dear ImGui: takes input events, returns draw lists. Works with version 1.86 (Debian 12) and later.
#include <imgui.h>

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "view/input.hpp"

namespace rill::view {

enum class Theme { Dark, Light };

class Interface {
 public:
  /// `scale`: of text and buttons. `paste`, `copy`: clipboard access.
  Interface(float scale, std::function<std::string()> paste, std::function<void(const char*)> copy);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void addEvent(const InputEvent& event) { waiting_.push_back(event); }
  /// Starts a frame with the queued events, in order, and returns them. Events that Dear ImGui cannot process in one frame
  /// wait for the next one: press and release of a key or button, a move after a click, a key after text.
  std::vector<InputEvent> begin(double seconds, uint32_t width, uint32_t height);
  bool waiting() const { return !waiting_.empty(); }
  /// Returns the draw lists, valid until the next begin().
  const ImDrawData& end();
  void skip() { ImGui::EndFrame(); }  ///< instead of end(), where nothing is drawn

  // Valid after begin().
  bool wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }
  bool wantsKeys() const { return ImGui::GetIO().WantTextInput; }
  ImFontAtlas& fonts() { return *ImGui::GetIO().Fonts; }
  float scale() const { return scale_; }

  void setTheme(Theme theme);
  Theme theme() const { return theme_; }

 private:
  std::vector<InputEvent> next();
  static void send(const InputEvent& event);

  float scale_;
  Theme theme_ = Theme::Dark;
  std::deque<InputEvent> waiting_;
  std::function<std::string()> paste_;
  std::function<void(const char*)> copy_;
  std::string pasted_;
};

}  // namespace rill::view
