#include "view/session.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "scene/json_text.hpp"
#include "scene/overrides.hpp"

namespace rill::view {

Expected<std::unique_ptr<Session>> Session::open(offline::Context& context, const std::filesystem::path& file,
                                                 std::vector<Override> changes) {
  std::unique_ptr<Session> made(new Session(context, file));
  if (auto started = made->read(std::move(changes)); !started) return started.error();
  return made;
}

Expected<Scene> Session::parse(std::string_view text, std::span<const Override> changes) const {
  auto scene = parseScene(text, file().string(), file().parent_path(), changes);
  if (scene) scene->file = file();
  return scene;
}

Expected<void> Session::read(std::vector<Override> changes) {
  watch_.acknowledge();
  auto text = readWholeFile(file(), kMaxSceneBytes);
  if (!text) return text.error();
  if (auto started = begin(*text, std::move(changes)); !started) return started;
  text_ = std::move(*text);
  return {};
}

Expected<void> Session::begin(std::string_view text, std::vector<Override> changes) {
  auto scene = parse(text, changes);
  if (!scene) return scene.error();
  auto runner = Runner::create(context_, std::move(*scene));
  if (!runner) return runner.error();
  if (auto started = (*runner)->begin(); !started) return started;
  changes_ = std::move(changes);
  painter_.reset();
  runner_ = std::move(*runner);
  resetPainter();
  return {};
}

void Session::resetPainter() { painter_ = std::make_unique<offline::Painter>(runner_->scene(), runner_->start(), 0); }

Expected<void> Session::changeSolids(std::vector<Solid> solids) {
  auto changed = runner_->changeSolids(std::move(solids));
  if (changed) resetPainter();
  return changed;
}

Expected<uint64_t> Session::add(const Fill& fill) {
  auto added = runner_->add(fill);
  if (added) resetPainter();
  return added;
}

void Session::release() {
  painter_.reset();
  if (runner_) released_ = runner_->kept();
  runner_.reset();
}

Expected<void> Session::resume() {
  auto runner = Runner::resume(context_, released_);
  if (!runner) return runner.error();
  runner_ = std::move(*runner);
  released_ = {};
  resetPainter();
  return {};
}

Expected<void> Session::restart() { return begin(text_, changes_); }

Expected<void> Session::reload() { return read(changes_); }

bool Session::isLive(std::string_view key) const {
  constexpr std::string_view kNeedsRestart[] = {"fluid.spacing",         "fluid.particles", "fluid.density",
                                                "fluid.smoothing_ratio", "solver.kernel",   "solver.neighbors"};
  if (std::ranges::find(kNeedsRestart, key) != std::end(kNeedsRestart)) return false;
  if (key == "gravity") return scene().gravity_changes.empty();
  return key.starts_with("fluid.") || key.starts_with("solver.") || key.starts_with("look.");
}

Expected<void> Session::apply(std::vector<Override> changes, bool live) {
  if (!live) return begin(text_, std::move(changes));
  auto scene = parse(text_, changes);
  if (!scene) return scene.error();
  if (auto changed = runner_->change(std::move(*scene)); !changed) return changed;
  changes_ = std::move(changes);
  resetPainter();
  return {};
}

Expected<void> Session::change(const Override& change) {
  std::vector<Override> changes = changes_;
  std::erase_if(changes, [&](const Override& other) { return other.key == change.key; });
  changes.push_back(change);
  return apply(std::move(changes), isLive(change.key));
}

Expected<void> Session::reset(std::string_view key) {
  std::vector<Override> changes = changes_;
  std::erase_if(changes, [&](const Override& other) { return other.key == key; });
  return apply(std::move(changes), isLive(key));
}

bool Session::isChanged(std::string_view key) const {
  return std::ranges::any_of(changes_, [&](const Override& change) { return change.key == key; });
}

Expected<std::string> Session::text(const std::filesystem::path& folder) const {
  auto root = parseJsonText(text_, file().string());
  if (!root) return root.error();
  OverrideMarks marks;
  if (auto applied = applyOverrides(*root, changes_, marks); !applied) return applied.error();
  const auto scene = parse(text_, changes_);
  if (!scene) return scene.error();
  const auto fromFolder = [&](const std::filesystem::path& whole) {
    std::error_code ignored;
    return std::filesystem::proximate(whole, std::filesystem::absolute(folder, ignored), ignored).string();
  };
  for (size_t k = 0; k < scene->fill.size(); ++k)
    if (const auto* particles = std::get_if<ParticleFile>(&scene->fill[k].shape))
      (*root)["fill"][k]["particles"]["file"] = fromFolder(particles->file);
  if (!scene->look.environment.empty()) (*root)["look"]["environment"] = fromFolder(scene->look.environment);
  return root->dump(2) + "\n";
}

}  // namespace rill::view
