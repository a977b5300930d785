// Changes of a running simulation, which continues from a snapshot; and the state that it keeps.
#include <algorithm>
#include <cmath>

#include "fluid/snapshot.hpp"
#include "view/runner.hpp"

namespace rill::view {
namespace {

/// Whether the fluid had a buffer on the device: particles or bodies.
bool hasState(const FluidSnapshot& snapshot) { return !snapshot.control.empty(); }

}  // namespace

Expected<void> Runner::continueFrom(Scene scene, std::shared_ptr<const ParticleSet> start, FluidSnapshot from) {
  auto fluid = fluidOf(scene, *start, hasState(from) ? &from : nullptr);
  if (!fluid) return fluid.error();
  const auto now = whitewater();
  if (!now) return now.error();
  auto white = whitewaterOf(*fluid, scene, *start, white_ && hasState(from) ? &*now : nullptr);
  if (!white) return white.error();
  fluid_ = std::move(*fluid);
  white_ = *std::move(white);
  scene_ = std::move(scene);
  advances_.setFluid(*fluid_, scene_);
  start_ = std::move(start);
  keep(std::move(from));
  return begin();
}

void Runner::keep(FluidSnapshot now) {
  kept_ = {scene_, start_, firstBounds_, {}, steps_, flows_, tapRoom_};
  if (hasState(now)) kept_.snapshot = std::move(now);
}

Expected<void> Runner::keep(uint32_t particles) {
  if (count() > particles) return {};
  auto now = snapshot();
  if (!now) return now.error();
  keep(std::move(*now));
  return {};
}

Expected<void> Runner::change(Scene scene) {
  auto now = snapshot();
  if (!now) return now.error();
  if (!(scene.fluid.spacing > 0)) scene.fluid.spacing = scene_.fluid.spacing;  // derived from the fills, which are unchanged
  std::vector<Solid> solids = scene_.solids;
  for (size_t k = 0; k < std::min(solids.size(), scene.solids.size()); ++k) {
    if (!solids[k].body || !scene.solids[k].body) continue;
    solids[k].body->density = scene.solids[k].body->density;
    solids[k].body->mass = scene.solids[k].body->mass;
  }
  scene.solids = std::move(solids);
  if (hasState(*now)) wake(*now);
  scene.emitters = scene_.emitters;
  // The snapshot contains the current gravity.
  if (scene.gravity_changes.empty() && hasState(*now)) setGravity(*now, scene.gravity);
  return continueFrom(std::move(scene), start_, std::move(*now));
}

Expected<void> Runner::changeSolids(std::vector<Solid> solids) {
  auto now = snapshot();
  if (!now) return now.error();
  std::vector<Pose> poses;
  for (uint32_t k = 0; k < solids.size(); ++k) poses.push_back(k < scene_.solids.size() ? pose(k) : solidPose(solids[k], 0));
  if (hasState(*now)) replaceSolids(*now, scene_.solids, solids, poses, start_->origin);
  Scene scene = scene_;
  scene.solids = std::move(solids);
  if (auto done = continueFrom(std::move(scene), start_, std::move(*now)); !done) return done;
  targets_.clear();
  pulls_.clear();
  return {};
}

Expected<void> Runner::addTap(const Emitter& emitter, uint64_t room) {
  auto now = snapshot();
  if (!now) return now.error();
  Scene scene = scene_;
  scene.emitters.push_back(emitter);
  if (hasState(*now)) addEmitters(*now, scene_, scene, start_->origin);
  tapRoom_ = room;
  flows_.push_back(0);
  if (auto done = continueFrom(std::move(scene), start_, std::move(*now)); !done) {
    tapRoom_ = 0;
    flows_.pop_back();
    return done;
  }
  setEmitter({.emitter = static_cast<uint32_t>(flows_.size() - 1)});
  return {};
}

Expected<void> Runner::changeTap(const std::string& fluid) {
  if (fluidIndex(scene_, scene_.emitters.back().fluid) == fluidIndex(scene_, fluid)) return {};
  auto now = snapshot();
  if (!now) return now.error();
  Scene scene = scene_;
  scene.emitters.back().fluid = fluid;
  return continueFrom(std::move(scene), start_, std::move(*now));
}

Expected<uint64_t> Runner::add(const Fill& fill) {
  auto now = snapshot();
  if (!now) return now.error();
  Scene only = scene_;
  only.fill = {fill};
  only.fluid.capacity = 0;
  if (only.fluid.spacing > 0) only.fluid.particles = 0;  // the spacing of what is there, whatever it was derived from
  for (uint32_t k = 0; k < only.solids.size(); ++k) {
    const Pose current = pose(k), first = solidPose(scene_.solids[k], 0);
    only.solids[k].motion = {
        {0, {current.center[0] - first.center[0], current.center[1] - first.center[1], current.center[2] - first.center[2]}}};
    only.solids[k].rotation = current.rotation;
    only.solids[k].driven = 0;
    only.solids[k].body.reset();
  }
  const auto more = makeParticles(only);
  if (!more) return more.error();

  ParticleSet start = *start_;
  std::vector<Float3> positions;
  std::vector<uint8_t> fluids;
  const double apart = 0.9 * scene_.fluid.spacing;
  for (size_t i = 0; i < more->positions.size(); ++i) {
    const Float3& p = more->positions[i];
    const Float3 x{static_cast<float>(p.x + more->origin[0] - start.origin[0]), static_cast<float>(p.y + more->origin[1] - start.origin[1]),
                   static_cast<float>(p.z + more->origin[2] - start.origin[2])};
    const bool free = std::ranges::none_of(
        now->position, [&](const Float3& other) { return std::hypot(other.x - x.x, other.y - x.y, other.z - x.z) < apart; });
    if (!free) continue;
    positions.push_back(x);
    if (scene_.fluids.size() > 1) fluids.push_back(more->fluids[i]);
  }
  if (4 * positions.size() < more->positions.size()) return Error{ErrorKind::BadInput, "There is no room for more fluid there"};
  const std::vector<Float3> velocities(positions.size(), more->velocities.front());
  start.positions.insert(start.positions.end(), positions.begin(), positions.end());
  start.velocities.insert(start.velocities.end(), velocities.begin(), velocities.end());
  if (!start.fluids.empty()) start.fluids.resize(start.positions.size());
  std::ranges::copy(fluids, start.fluids.end() - std::ssize(fluids));
  if (hasState(*now)) append(*now, positions, velocities, fluids);
  if (auto done = continueFrom(scene_, std::make_shared<const ParticleSet>(std::move(start)), std::move(*now)); !done) return done.error();
  return positions.size();
}

}  // namespace rill::view
