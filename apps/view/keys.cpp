#include "view/keys.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>

namespace rill::view {
namespace {

constexpr KeyBinding kBindings[] = {{GLFW_KEY_P, "P", Action::Pause, "pause or continue"},
                                    {GLFW_KEY_O, "O", Action::OneStep, "one step of 1/60 s, then pause"},
                                    {GLFW_KEY_R, "R", Action::Restart, "restart the scene"},
                                    {GLFW_KEY_LEFT_BRACKET, "[", Action::PreviousScene, "previous scene"},
                                    {GLFW_KEY_RIGHT_BRACKET, "]", Action::NextScene, "next scene"},
                                    {GLFW_KEY_V, "V", Action::NextView, "next view; with Shift the one before"},
                                    {GLFW_KEY_SPACE, "Space", Action::Throw, "throw a ball of fluid at what is under the pointer"},
                                    {GLFW_KEY_B, "B", Action::ThrowCrate, "throw a crate at it"},
                                    {GLFW_KEY_T, "T", Action::Pour, "while held: pour fluid at it"},
                                    {GLFW_KEY_HOME, "Home", Action::Home, "frame the scene"},
                                    {GLFW_KEY_1, "1", Action::Front, "look from the front"},
                                    {GLFW_KEY_2, "2", Action::Back, "from behind"},
                                    {GLFW_KEY_3, "3", Action::Right, "from the right"},
                                    {GLFW_KEY_4, "4", Action::Left, "from the left"},
                                    {GLFW_KEY_5, "5", Action::Top, "from above"},
                                    {GLFW_KEY_6, "6", Action::Bottom, "from below"},
                                    {GLFW_KEY_LEFT, "Left", Action::TiltLeft, "tilt gravity to the left of the picture, by 10 degrees"},
                                    {GLFW_KEY_RIGHT, "Right", Action::TiltRight, "to the right"},
                                    {GLFW_KEY_UP, "Up", Action::TiltAway, "away from you"},
                                    {GLFW_KEY_DOWN, "Down", Action::TiltTowards, "towards you"},
                                    {GLFW_KEY_TAB, "Tab", Action::Panels, "hide or show the panels"},
                                    {GLFW_KEY_L, "L", Action::Theme, "dark or light panels"},
                                    {GLFW_KEY_C, "C", Action::Screenshot, "write the window to a PNG file"},
                                    {GLFW_KEY_F1, "F1", Action::Help, "this help"}};

constexpr MouseUse kMouse[] = {
    {"left drag", "on the fluid: push it; elsewhere, while paused, or with Alt: orbit the camera"},
    {"right drag", "on a body: pull it; on other solids: move them; elsewhere: move the camera nearer or farther"},
    {"wheel", "move the camera nearer or farther, towards the pointer"},
    {"middle drag", "pan the camera (also Shift and left drag)"},
    {"drop a file", "open a scene"}};

struct NamedKey {
  std::string_view name;
  int key;
};
constexpr NamedKey kOthers[] = {{"Enter", GLFW_KEY_ENTER},
                                {"Escape", GLFW_KEY_ESCAPE},
                                {"Backspace", GLFW_KEY_BACKSPACE},
                                {"End", GLFW_KEY_END},
                                {"Delete", GLFW_KEY_DELETE}};

bool same(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, {}, [](unsigned char c) { return std::tolower(c); }, [](unsigned char c) { return std::tolower(c); });
}

}  // namespace

std::span<const KeyBinding> keyBindings() { return kBindings; }
std::span<const MouseUse> mouseUses() { return kMouse; }

std::string keyHelp() {
  std::string text;
  const auto line = [&](std::string_view what, std::string_view about) {
    text += "  " + std::string(what) + std::string(what.size() < 20 ? 20 - what.size() : 1, ' ') + std::string(about) + "\n";
  };
  for (const MouseUse& use : kMouse) line(use.how, use.about);
  for (const KeyBinding& binding : kBindings) line(binding.name, binding.about);
  return text;
}

std::optional<int> keyNamed(std::string_view name) {
  for (const KeyBinding& binding : kBindings)
    if (same(binding.name, name)) return binding.key;
  for (const NamedKey& other : kOthers)
    if (same(other.name, name)) return other.key;
  return std::nullopt;
}

}  // namespace rill::view
