#include "view/script.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/words.hpp"
#include "scene/json_text.hpp"
#include "shared/option_text.hpp"
#include "view/keys.hpp"

namespace rill::view {
namespace {

struct Command {
  std::string_view name, arguments, about;
  size_t count;  ///< of arguments
};
constexpr Command kCommands[] = {{"move", "X Y", "move the pointer, in pixels from the top left", 2},
                                 {"press", "left|middle|right", "press a mouse button; Alt+left: with a modifier key", 1},
                                 {"release", "left|middle|right", "release it", 1},
                                 {"wheel", "STEPS", "turn the wheel; positive is away from you", 1},
                                 {"key", "NAME", "press and release a key: P, Tab, F1, Enter, Shift+V ...", 1},
                                 {"hold", "NAME", "press a key, and keep it pressed", 1},
                                 {"lift", "NAME", "release it", 1},
                                 {"type", "TEXT", "type text without spaces into the focused field", 1},
                                 {"drop", "FILE", "drop a file onto the window", 1},
                                 {"set", "KEY=VALUE", "override a key of the scene, for example fluid.viscosity=0.1", 1},
                                 {"scene", "NAME", "open a scene", 1},
                                 {"view", "NAME", "show a view", 1},
                                 {"resize", "WIDTH HEIGHT", "resize the window, in pixels", 2},
                                 {"minimize", "", "minimize the window", 0},
                                 {"restore", "", "restore the window", 0},
                                 {"screenshot", "FILE", "write the window after this frame as PNG", 1}};

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (size_t at = 0;;) {
    at = line.find_first_not_of(" \t\r", at);
    if (at == std::string_view::npos) return words;
    const size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

std::optional<double> finite(std::string_view text) {
  const auto value = apps::numberIn<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> button(std::string_view name) {
  if (name == "left") return GLFW_MOUSE_BUTTON_LEFT;
  if (name == "middle") return GLFW_MOUSE_BUTTON_MIDDLE;
  if (name == "right") return GLFW_MOUSE_BUTTON_RIGHT;
  return std::nullopt;
}

/// Removes the prefixes "Shift+", "Ctrl+", "Alt+" of a name; returns them as GLFW modifiers.
int takeModifiers(std::string_view& name) {
  constexpr std::pair<std::string_view, int> kHeld[] = {{"Shift+", GLFW_MOD_SHIFT}, {"Ctrl+", GLFW_MOD_CONTROL}, {"Alt+", GLFW_MOD_ALT}};
  int modifiers = 0;
  for (bool found = true; found;) {
    found = false;
    for (const auto& [word, bit] : kHeld)
      if (name.starts_with(word)) {
        name.remove_prefix(word.size());
        modifiers |= bit;
        found = true;
      }
  }
  return modifiers;
}

/// Parses a line and appends it to `lines`; returns an error message, or an empty string.
std::string parseLine(const std::vector<std::string_view>& words, std::vector<ScriptLine>& lines) {
  const auto frame = apps::numberIn<uint64_t>(words[0]);
  if (!frame) return "the line does not begin with a number; expected that of a frame";  // without the content: it may be any file's
  if (!lines.empty() && *frame < lines.back().frame)
    return "frame " + std::to_string(*frame) + " comes after frame " + std::to_string(lines.back().frame) + "; expected ascending frames";
  std::vector<std::string_view> names;
  for (const Command& command : kCommands) names.push_back(command.name);
  if (words.size() < 2) return "no command after the frame number";
  const auto command = std::ranges::find(kCommands, words[1], &Command::name);
  if (command == std::end(kCommands)) {
    const std::string_view near = nearestWord(words[1], names);
    return "unknown command " + inQuotes(words[1]) + (near.empty() ? "" : "; did you mean " + inQuotes(near) + "?");
  }
  const auto expected = [&] {
    return std::string(words[1]) + ": expected \"" + std::string(words[1]) + " " + std::string(command->arguments) + "\"";
  };
  if (words.size() != 2 + command->count) return expected();
  const std::string_view what = words[1], first = words.size() > 2 ? words[2] : std::string_view();

  ScriptLine line;
  line.frame = *frame;
  if (what == "move") {
    const auto x = finite(first), y = finite(words[3]);
    if (!x || !y) return expected();
    line.input = {.kind = InputEvent::Kind::Move, .x = *x, .y = *y};
  } else if (what == "press" || what == "release") {
    std::string_view name = first;
    const int modifiers = takeModifiers(name);
    const auto code = button(name);
    if (!code) return expected();
    line.input = {.kind = InputEvent::Kind::Button, .code = *code, .down = what == "press", .modifiers = modifiers};
  } else if (what == "wheel") {
    const auto steps = finite(first);
    if (!steps) return expected();
    line.input = {.kind = InputEvent::Kind::Wheel, .y = *steps};
  } else if (what == "key" || what == "hold" || what == "lift") {
    std::string_view name = first;
    const int modifiers = takeModifiers(name);
    const auto key = keyNamed(name);
    if (!key) return "unknown key " + inQuotes(name);
    line.input = {.kind = InputEvent::Kind::Key, .code = *key, .down = what != "lift", .modifiers = modifiers};
    if (what == "key") {
      lines.push_back(line);
      line.input.down = false;
    }
  } else if (what == "type" || what == "drop") {
    line.input.kind = what == "type" ? InputEvent::Kind::Text : InputEvent::Kind::Drop;
    line.input.text = first;
  } else if (what == "set") {
    auto change = parseOverride(first);
    if (!change) return change.error().message;
    line.kind = ScriptLine::Kind::Set;
    line.change = std::move(*change);
  } else if (what == "resize") {
    const auto width = apps::numberIn<uint32_t>(first), height = apps::numberIn<uint32_t>(words[3]);
    if (!width || !height || std::min(*width, *height) < 1 || std::max(*width, *height) > 8192) return expected();
    line.kind = ScriptLine::Kind::Resize;
    line.width = *width;
    line.height = *height;
  } else {
    line.kind = what == "scene"      ? ScriptLine::Kind::Scene
                : what == "view"     ? ScriptLine::Kind::View
                : what == "minimize" ? ScriptLine::Kind::Minimize
                : what == "restore"  ? ScriptLine::Kind::Restore
                                     : ScriptLine::Kind::Screenshot;
    line.name = first;
  }
  lines.push_back(std::move(line));
  return {};
}

}  // namespace

Expected<std::vector<ScriptLine>> parseScript(std::string_view text, std::string_view name) {
  std::vector<ScriptLine> lines;
  size_t row = 0;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    ++row;
    if (const auto words = wordsOf(text.substr(0, end)); !words.empty())
      if (const std::string error = parseLine(words, lines); !error.empty())
        return Error{ErrorKind::BadInput, std::string(name) + ":" + std::to_string(row) + ": " + error};
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Expected<std::vector<ScriptLine>> loadScript(const std::filesystem::path& file) {
  auto text = readWholeFile(file, kMaxSceneBytes);
  if (!text) return text.error();
  return parseScript(*text, file.string());
}

std::string scriptHelp() {
  std::string text;
  for (const Command& command : kCommands) {
    const std::string how = std::string(command.name) + (command.arguments.empty() ? "" : " ") + std::string(command.arguments);
    text += "  " + how + std::string(how.size() < 26 ? 26 - how.size() : 1, ' ') + std::string(command.about) + "\n";
  }
  return text;
}

}  // namespace rill::view
