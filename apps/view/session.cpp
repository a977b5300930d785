#include "view/session.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/words.hpp"
#include "scene/json_text.hpp"
#include "scene/overrides.hpp"
#include "shape/mass.hpp"

namespace rill::view {
namespace {

constexpr std::string_view kDensityKey = ".body.density", kMassKey = ".body.mass";

/// The index in "solids[N].body.density" or "solids[N].body.mass".
std::optional<size_t> bodyOfMass(std::string_view key) {
  constexpr std::string_view kSolids = "solids[";
  if (!key.starts_with(kSolids)) return std::nullopt;
  key.remove_prefix(kSolids.size());
  size_t solid = 0;
  const auto read = std::from_chars(key.data(), key.data() + key.size(), solid);
  if (read.ec != std::errc()) return std::nullopt;
  const std::string_view rest(read.ptr, static_cast<size_t>(key.data() + key.size() - read.ptr));
  if (!rest.starts_with(']')) return std::nullopt;
  return rest.substr(1) == kDensityKey || rest.substr(1) == kMassKey ? std::optional(solid) : std::nullopt;
}

}  // namespace

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
  const size_t solids = scene->solids.size();
  auto runner = Runner::create(context_, std::move(*scene));
  if (!runner) return runner.error();
  if (auto started = (*runner)->begin(); !started) return started;
  changes_ = std::move(changes);
  fileSolids_ = solids;
  painter_.reset();
  runner_ = std::move(*runner);
  resetPainter();
  return {};
}

void Session::resetPainter() { painter_ = std::make_unique<offline::Painter>(runner_->scene(), runner_->start()); }

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

Expected<void> Session::addTap(const Emitter& emitter, uint64_t room) {
  auto added = runner_->addTap(emitter, room);
  if (added) resetPainter();
  return added;
}

Expected<void> Session::changeTap(const std::string& fluid) {
  auto changed = runner_->changeTap(fluid);
  if (changed) resetPainter();
  return changed;
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
  constexpr std::string_view kNeedsRestart[] = {"fluid.spacing",         "fluid.particles", "fluid.density",   "fluid.smoothing_ratio",
                                                "fluid.surface_tension", "solver.kernel",   "solver.neighbors"};
  if (std::ranges::find(kNeedsRestart, key) != std::end(kNeedsRestart)) return false;
  if (const auto solid = bodyOfMass(key)) return *solid < fileSolids_ && scene().solids[*solid].body.has_value();
  if (key == "gravity") return scene().gravity_changes.empty();
  constexpr std::string_view kLiveMaterials[] = {".viscosity", ".yield_stress", ".flow_index", ".color"};
  if (key.starts_with("fluids")) return std::ranges::any_of(kLiveMaterials, [&](std::string_view end) { return key.ends_with(end); });
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

Expected<void> Session::changeDensity(uint32_t solid, double density) {
  const Solid& old = scene().solids[solid];
  const bool mass = old.body->mass > 0;
  const double value = mass ? density * massOf(old.shape, 1).mass : density;
  if (solid < fileSolids_) return change({elementPath("solids", solid) + (mass ? kMassKey : kDensityKey).data(), shortestNumber(value)});
  std::vector<Solid> solids = scene().solids;
  solids[solid].body->density = value;
  return changeSolids(std::move(solids));
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
