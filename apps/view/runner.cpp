#include "view/runner.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/vector_math.hpp"
#include "fill/mouth.hpp"
#include "fluid/snapshot.hpp"
#include "offline/readout.hpp"
#include "offline/state_hash.hpp"
#include "offline/whitewater_run.hpp"
#include "shape/mass.hpp"
#include "view/clock.hpp"

namespace rill::view {
namespace {

/// Whether the fluid had a buffer on the device: particles or bodies.
bool hasState(const FluidSnapshot& snapshot) { return !snapshot.control.empty(); }

}  // namespace

Expected<std::unique_ptr<Runner>> Runner::create(offline::Context& context, Scene scene) {
  std::unique_ptr<Runner> runner(new Runner(context, std::move(scene)));
  auto start = makeParticles(runner->scene_);
  if (!start) return start.error();
  runner->start_ = std::make_shared<const ParticleSet>(std::move(*start));
  runner->scene_.fluid.spacing = runner->start_->spacing;
  runner->firstBounds_ = fluidBounds(runner->scene_, *runner->start_);
  if (auto made = runner->makeFluid(nullptr); !made) return made.error();
  for (const Emitter& emitter : runner->scene_.emitters) runner->flows_.push_back(flowOf(emitter));
  runner->keep(FluidSnapshot());
  return runner;
}

Expected<std::unique_ptr<Runner>> Runner::resume(offline::Context& context, const KeptState& kept) {
  std::unique_ptr<Runner> runner(new Runner(context, kept.scene));
  runner->start_ = kept.start;
  runner->firstBounds_ = kept.firstBounds;
  runner->steps_ = kept.steps;
  runner->tapRoom_ = kept.tapRoom;
  runner->flows_ = kept.flows;
  if (runner->tap()) runner->flows_.back() = 0;
  for (uint32_t k = 0; k < kept.flows.size(); ++k)
    if (runner->flows_[k] != flowOf(kept.scene.emitters[k])) runner->setEmitter({.emitter = k, .flow = runner->flows_[k]});
  if (auto made = runner->makeFluid(kept.snapshot ? &*kept.snapshot : nullptr); !made) return made.error();
  if (auto begun = runner->begin(); !begun) return begun.error();
  runner->kept_ = kept;
  return runner;
}

Expected<Fluid> Runner::fluidOf(const Scene& scene, const ParticleSet& start, const FluidSnapshot* from) {
  uint64_t capacity = 0;
  if (tapRoom_ > 0) {
    Scene own = scene;  // without the tap
    own.emitters.pop_back();
    capacity = std::min<uint64_t>(capacityOf(own, start.positions.size()) + tapRoom_, maxParticles(context_.device(), scene));
  }
  return Fluid::create(context_.device(),
                       {.scene = &scene, .particles = &start, .snapshot = from, .capacity = static_cast<uint32_t>(capacity)});
}

Expected<void> Runner::makeFluid(const FluidSnapshot* from) {
  auto fluid = fluidOf(scene_, *start_, from);
  if (!fluid) return fluid.error();
  auto white = whitewaterOf(*fluid, scene_, *start_, nullptr);
  if (!white) return white.error();
  fluid_ = std::move(*fluid);
  white_ = *std::move(white);
  advances_.setFluid(*fluid_, scene_);
  return {};
}

/// `from`: the state to continue from; null: none yet.
Expected<std::optional<Whitewater>> Runner::whitewaterOf(const Fluid& fluid, const Scene& scene, const ParticleSet& start,
                                                         const WhitewaterSnapshot* from) {
  if (!scene.look.whitewater || fluid.capacity() == 0) return std::optional<Whitewater>{};
  WhitewaterDesc desc = offline::whitewaterOf(scene, start, fluid.capacity());
  desc.snapshot = from;
  if (from && white_) desc.parcel_m3 = white_->desc().parcel_m3;  // added fluid does not change what is there
  auto made = Whitewater::create(context_.device(), desc);
  if (!made) return Error{made.error().kind, "look.whitewater: " + made.error().message};
  return std::optional(*std::move(made));
}

template <class Declare>
Expected<void> Runner::run(Graph& graph, Declare&& declare) {
  graph.reset();
  declare(graph);
  if (auto ran = context_.run(graph); !ran) return ran;
  return context_.wait();
}

Expected<void> Runner::begin() {
  return run(measureGraph_, [&](Graph& graph) { static_cast<void>(fluid_->addTo(graph, {})); });
}

Expected<void> Runner::advancePiece(double budget_s, bool more) {
  if (advances_.inFlight() == 0)
    if (auto idle = context_.wait(); !idle) return idle;  // rendering is not part of the measured time
  const offline::Advances::Work work{.advance_s = Clock::kStep,
                                     .advances = advances_.ended() + (more && !white_ ? 2 : 1),  // whitewater moves between steps
                                     .budget_s = budget_s,
                                     .targets = targets_,
                                     .pulls = pulls_,
                                     .emitters = emitters_};
  const uint64_t before = begun();
  if (auto submitted = advances_.submit(work); !submitted) return submitted;
  if (begun() > before) emitters_.clear();
  return finishPiece();
}

Expected<void> Runner::finishPiece() {
  const auto ended = advances_.finish(log_, true);
  if (!ended) return ended.error();
  if (!*ended) return {};
  const offline::AdvanceFigures& done = advances_.last();
  last_ = {.substeps = done.progress.substeps,
           .iterations = done.progress.iterations,
           .pieces = done.pieces,
           .timeDropped_s = std::max(done.progress.timeDropped_s, done.progress.timeLeft_s),
           .seconds = done.seconds};
  shown_ = log_;
  ++steps_;
  return white_ ? stepWhitewater() : Expected<void>();
}

/// For the step that has ended.
Expected<void> Runner::stepWhitewater() {
  if (auto settled = settle(); !settled) return settled;
  return run(whiteGraph_, [&](Graph& graph) {
    const double seconds = std::max(Clock::kStep - last_.timeDropped_s, 0.0);
    static_cast<void>(white_->addTo(graph, fluid_->addTo(graph, {}), seconds, offline::gravityAt(scene_, time_s())));
  });
}

offline::DrawnWhitewater Runner::presentWhitewater(Graph& graph, const FluidState& fluid) {
  if (!white_) return {};
  return {white_->addTo(graph, fluid, 0), offline::drawnRadius(white_->desc())};
}

Expected<WhitewaterSnapshot> Runner::whitewater() {
  if (!white_) return WhitewaterSnapshot{};
  offline::WhitewaterTickets tickets;
  auto ran = run(whiteGraph_, [&](Graph& graph) { tickets = offline::whitewaterReadout(graph, white_->addTo(graph, {}, 0)); });
  if (!ran) return ran.error();
  return offline::collectWhitewater(whiteGraph_, tickets);
}

Expected<void> Runner::settle() {
  while (advances_.inFlight() > 0)
    if (auto finished = finishPiece(); !finished) return finished;
  return {};
}

bool Runner::mayStayBusy() const {
  return timed_ && std::ranges::none_of(scene_.solids, [](const Solid& solid) { return solid.driven > 0 || !solid.motion.empty(); });
}

Expected<void> Runner::step() {
  constexpr double kPiece = 0.1;  // s
  do {
    if (auto ran = advancePiece(kPiece); !ran) return ran;
  } while (!betweenSteps());
  return settle();
}

Expected<FluidStats> Runner::measure() {
  if (auto settled = settle(); !settled) return settled.error();
  auto ran = run(measureGraph_, [&](Graph& graph) { static_cast<void>(fluid_->addTo(graph, {.stats = true})); });
  if (!ran) return ran.error();
  return fluid_->stats().value_or(FluidStats{});
}

Expected<uint64_t> Runner::hash() {
  if (auto settled = settle(); !settled) return settled.error();
  offline::ReadoutTickets tickets;
  auto ran = run(measureGraph_, [&](Graph& graph) { tickets = offline::readout(graph, fluid_->addTo(graph, {})); });
  if (!ran) return ran.error();
  const offline::Readout read = offline::collect(measureGraph_, tickets);
  return offline::stateHash(read.positions, read.velocities, read.ids, fluid_->bodies(), read.fluids, read.concentrations);
}

Expected<FluidSnapshot> Runner::snapshot() {
  if (!betweenSteps())
    if (auto ended = step(); !ended) return ended.error();
  if (auto settled = settle(); !settled) return settled.error();
  if (auto ready = begin(); !ready) return ready.error();
  SnapshotReader reader(*fluid_);
  for (Graph graph; !reader.done();) {
    if (auto ran = run(graph, [&](Graph& g) { reader.declare(g); }); !ran) return ran.error();
    if (auto taken = reader.take(graph); !taken) return taken.error();
  }
  return std::move(reader.snapshot());
}

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

std::optional<uint32_t> Runner::tap() const {
  return tapRoom_ > 0 ? std::optional(static_cast<uint32_t>(flows_.size() - 1)) : std::nullopt;
}

void Runner::setEmitter(const EmitterTarget& target) {
  std::erase_if(emitters_, [&](const EmitterTarget& other) { return other.emitter == target.emitter; });
  emitters_.push_back(target);
  flows_[target.emitter] = target.flow;
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

Pose Runner::pose(uint32_t solid) const {
  for (const BodyMotion& motion : fluid_->bodies())
    if (motion.solid == solid)
      return poseOfSolid(
          scene_.solids[solid].shape,
          {.center = motion.center, .rotation = motion.rotation, .velocity = motion.velocity, .angularVelocity = motion.angularVelocity});
  Pose current = solidPose(scene_.solids[solid], time_s());
  if (scene_.solids[solid].driven > 0) {
    current.center = fluid_->drivenCenter(solid);
    current.rotation = fluid_->drivenRotation(solid);
  }
  return current;
}

void Runner::setTarget(const SolidTarget& target) {
  std::erase_if(targets_, [&](const SolidTarget& other) { return other.solid == target.solid; });
  targets_.push_back(target);
}

Expected<std::vector<Float3>> Runner::positions() {
  Ticket ticket;
  if (count() == 0) return std::vector<Float3>{};
  auto ran = run(measureGraph_, [&](Graph& graph) { ticket = graph.readback(fluid_->present(graph).position); });
  if (!ran) return ran.error();
  const auto bytes = measureGraph_.data(ticket);
  std::vector<Float3> positions(count());
  for (size_t i = 0; i < positions.size() && (i + 1) * sizeof(Float4) <= bytes.size(); ++i)
    std::memcpy(&positions[i], bytes.data() + i * sizeof(Float4), sizeof(Float3));
  return positions;
}

std::vector<std::string> Runner::warnings() const {
  std::vector<std::string> all = start_->warnings;
  all.insert(all.end(), fluid_->warnings().begin(), fluid_->warnings().end());
  return all;
}

}  // namespace rill::view
