#include "view/runner.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstddef>
#include <limits>

#include "offline/readout.hpp"
#include "offline/state_hash.hpp"
#include "shared/fluid_records.h"
#include "sort/key_sort_types.hpp"
#include "view/clock.hpp"

namespace rill::view {

Expected<std::unique_ptr<Runner>> Runner::create(offline::Context& context, Scene scene) {
  std::unique_ptr<Runner> runner(new Runner(context, std::move(scene)));
  auto start = makeParticles(runner->scene_, KeySortDesc::kMaxCount);
  if (!start) return start.error();
  runner->start_ = std::move(*start);
  auto fluid = Fluid::create(context.device(), {.scene = &runner->scene_, .particles = &runner->start_});
  if (!fluid) return fluid.error();
  runner->fluid_ = std::move(*fluid);
  runner->pacing_ = Pacing(std::max(1u, runner->fluid_->substepsPerBlock()));
  return runner;
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

Expected<void> Runner::piece(double budget_s) {
  using Now = std::chrono::steady_clock;
  if (auto idle = context_.wait(); !idle) return idle;  // what was drawn before is not part of the piece
  const Now::time_point before = Now::now();
  if (recorded_ == 0) {
    current_ = {};
    log_.clear();
  }
  const uint32_t most = fluid_->mostSubsteps();
  const uint32_t substeps = std::min(pacing_.next(budget_s), most - recorded_);
  const FluidStep part{recorded_ == 0 ? Clock::kStep : 0.0, recorded_ > 0, substeps, false};
  if (auto ran = run(graph_, [&](Graph& graph) { static_cast<void>(fluid_->addTo(graph, part)); }); !ran) return ran;
  log_.add(graph_.report(), true);
  log_.add(graph_.timings());

  const double seconds = std::chrono::duration<double>(Now::now() - before).count();
  const FluidProgress& progress = fluid_->progress();
  recorded_ += substeps;
  pacing_.ran(substeps, progress.substeps - std::min(done_, progress.substeps), seconds);
  done_ = progress.substeps;
  ++current_.pieces;
  current_.wall_s += seconds;
  if (progress.time_left_s > 0 && recorded_ < most) return {};

  pacing_.finished(progress.substeps);
  current_.substeps = progress.substeps;
  current_.iterations = progress.iterations;
  current_.time_dropped_s = std::max(progress.time_dropped_s, progress.time_left_s);
  last_ = current_;
  shown_ = log_;
  recorded_ = done_ = 0;
  ++steps_;
  return {};
}

Expected<void> Runner::step() {
  do {
    if (auto ran = piece(std::numeric_limits<double>::infinity()); !ran) return ran;
  } while (!between());
  return {};
}

Expected<FluidStats> Runner::measure() {
  auto ran = run(measureGraph_, [&](Graph& graph) { static_cast<void>(fluid_->addTo(graph, {.stats = true})); });
  if (!ran) return ran.error();
  return fluid_->stats().value_or(FluidStats{});
}

Expected<uint64_t> Runner::hash() {
  offline::ReadoutTickets tickets;
  auto ran = run(measureGraph_, [&](Graph& graph) { tickets = offline::readout(graph, fluid_->addTo(graph, {})); });
  if (!ran) return ran.error();
  const offline::Readout read = offline::collect(measureGraph_, tickets);
  return offline::stateHash(read.positions, read.velocities, read.ids);
}

Expected<void> Runner::change(Scene scene) {
  if (!between())
    if (auto ended = step(); !ended) return ended;
  if (!(scene.fluid.spacing > 0)) scene.fluid.spacing = scene_.fluid.spacing;  // follows from the fills, which are the same
  if (auto ready = begin(); !ready) return ready;
  SnapshotReader reader(*fluid_);
  for (Graph graph; !reader.done();) {
    if (auto ran = run(graph, [&](Graph& g) { reader.declare(g); }); !ran) return ran;
    if (auto taken = reader.take(graph); !taken) return taken;
  }
  FluidSnapshot& now = reader.snapshot();
  if (scene.gravity_changes.empty() && !now.control.empty())  // the device holds the one that is in force
    for (int a = 0; a < 3; ++a)
      now.control[offsetof(FluidControl, gravityX) / 4 + a] = std::bit_cast<uint32_t>(static_cast<float>(scene.gravity[a]));
  auto fluid = Fluid::create(context_.device(), {.scene = &scene, .particles = &start_, .snapshot = &now});
  if (!fluid) return fluid.error();
  fluid_ = std::move(*fluid);
  scene_ = std::move(scene);
  return begin();
}

std::vector<std::string> Runner::warnings() const {
  std::vector<std::string> all = start_.warnings;
  all.insert(all.end(), fluid_->warnings().begin(), fluid_->warnings().end());
  return all;
}

}  // namespace rill::view
