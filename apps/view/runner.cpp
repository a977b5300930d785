#include "view/runner.hpp"

#include <algorithm>
#include <cstring>

#include "fill/mouth.hpp"
#include "offline/readout.hpp"
#include "offline/state_hash.hpp"
#include "offline/whitewater_run.hpp"
#include "shape/mass.hpp"
#include "view/clock.hpp"

namespace rill::view {

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

std::optional<uint32_t> Runner::tap() const {
  return tapRoom_ > 0 ? std::optional(static_cast<uint32_t>(flows_.size() - 1)) : std::nullopt;
}

void Runner::setEmitter(const EmitterTarget& target) {
  std::erase_if(emitters_, [&](const EmitterTarget& other) { return other.emitter == target.emitter; });
  emitters_.push_back(target);
  flows_[target.emitter] = target.flow;
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
