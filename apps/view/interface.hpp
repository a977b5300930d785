#pragma once
// Dear ImGui's context: what hands do goes in, lists to draw come out. Works with the versions of Debian 12 (1.86) and later ones.
#include <imgui.h>

#include <functional>
#include <string>

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

  void feed(const InputEvent& event);
  void begin(double seconds, uint32_t width, uint32_t height);
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
  float scale_;
  Theme theme_ = Theme::Dark;
#if IMGUI_VERSION_NUM < 18700            // later ones queue what happens in a frame
  bool pressed_[3] = {}, down_[3] = {};  // a click shorter than a frame is still one
#endif
  std::function<std::string()> paste_;
  std::function<void(const char*)> copy_;
  std::string pasted_;
};

}  // namespace rill::view
