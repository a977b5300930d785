#include "view/script_player.hpp"

#include <algorithm>

#include "core/words.hpp"
#include "rill/offline.hpp"

namespace rill::view {

Expected<void> checkNames(const std::vector<ScriptLine>& lines, const apps::SceneFolders& folders) {
  const auto views = offline::Simulation::views();
  for (const ScriptLine& line : lines) {
    if (line.kind == ScriptLine::Kind::Scene)
      if (auto file = folders.find(line.name); !file) return file.error();
    if (line.kind == ScriptLine::Kind::View && std::ranges::find(views, line.name) == views.end())
      return Error{ErrorKind::BadInput, "--script: unknown view " + inQuotes(line.name)};
  }
  return {};
}

Expected<ScriptPlayer::Frame> ScriptPlayer::play(uint64_t frame) {
  Frame asked;
  for (; next_ < lines_.size() && lines_[next_].frame <= frame; ++next_) {
    const ScriptLine& line = lines_[next_];
    Expected<void> done;
    switch (line.kind) {
      case ScriptLine::Kind::Input:
        asked.events.push_back(line.input);
        break;
      case ScriptLine::Kind::Set:
        done = shown_.change(line.change);
        break;
      case ScriptLine::Kind::Scene:
        done = scenes_.openNamed(line.name);
        break;
      case ScriptLine::Kind::View:
        settings_.view = line.name;
        break;
      case ScriptLine::Kind::Resize:
        window_.resize(line.width, line.height);
        break;
      case ScriptLine::Kind::Minimize:
        window_.minimize(true);
        break;
      case ScriptLine::Kind::Restore:
        window_.minimize(false);
        break;
      case ScriptLine::Kind::Screenshot:
        asked.screenshot = line.name;
        break;
    }
    if (!done) return done.error();
  }
  return asked;
}

}  // namespace rill::view
