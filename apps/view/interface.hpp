#pragma once
// Dear ImGui's context: what hands do goes in, lists to draw come out. Works with the versions of Debian 12 (1.86) and later ones.
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
  /// `scale`: of text and buttons. Clipboard functions outlive it.
  Interface(float scale, std::function<std::string()> paste, std::function<void(const char*)> copy);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void feed(const InputEvent& event) { waiting_.push_back(event); }
  /// Takes what was fed, in order, as far as one displayed frame can show it: a key or a button that has gone down and up again, a
  /// pointer that moved on after a click, a key after a text waits for the next one. Returns what was taken.
  std::vector<InputEvent> begin(double seconds, uint32_t width, uint32_t height);
  bool waiting() const { return !waiting_.empty(); }
  /// The lists are valid until the next begin().
  const ImDrawData& end();
  void skip() { ImGui::EndFrame(); }  ///< in place of end(), where nothing is drawn

  // After begin(): where the pointer is now.
  bool wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }
  bool wantsKeys() const { return ImGui::GetIO().WantTextInput; }
  ImFontAtlas& fonts() { return *ImGui::GetIO().Fonts; }
  float scale() const { return scale_; }

  void setTheme(Theme theme);
  Theme theme() const { return theme_; }

 private:
  std::vector<InputEvent> next();
  static void tell(const InputEvent& event);

  float scale_;
  Theme theme_ = Theme::Dark;
  std::deque<InputEvent> waiting_;
  std::function<std::string()> paste_;
  std::function<void(const char*)> copy_;
  std::string pasted_;
};

}  // namespace rill::view
