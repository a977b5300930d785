// Advancing a simulation, and running a graph to its end.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

#include "offline/simulation_impl.hpp"
#include "offline/whitewater_run.hpp"
#include "whitewater/whitewater_records.h"

namespace rill::offline {
namespace {

constexpr double kPiece = 0.1;  // s that a submission should take: drivers give up on one after about two seconds

}  // namespace

Expected<void> Simulation::Impl::advance(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0)
    return Error{ErrorKind::BadInput, "advance: found " + std::to_string(seconds) + " s, expected a finite time of at least 0"};
  if (seconds == 0) return {};
  beginAdvance();
  advances_->abandon();  // what an error or an exception has left of the last one
  const auto before = std::chrono::steady_clock::now();
  if (auto ran = advanceFrames(seconds); !ran) return ran;
  wall_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  time_s_ += seconds;
  advanced_s_ = seconds;
  return {};
}

void Simulation::Impl::beginAdvance() {
  probes_.beginAdvance(*fluid_);
  pictures_.contentChanged();
  advanced_s_ = 0;
  if (measured_) asleep_ = fluid_->progress().asleep ? measured_ : std::nullopt;
  measured_.reset();
  advanced_ = {};
  wall_s_ = 0;
  pictureBoundHits_ = 0;
  log_.clear();
}

Expected<void> Simulation::Impl::advanceFrames(double seconds) {
  const auto frames = static_cast<uint64_t>(std::max(1.0, std::ceil(seconds / options_.longestFrame_s - 1e-9)));
  if (!white_) return advanceFluid(seconds / double(frames), frames);
  for (uint64_t k = 0; k < frames; ++k) {
    if (auto ran = advanceFluid(seconds / double(frames), 1); !ran) return ran;
    if (auto ran = stepWhitewater(); !ran) return ran;
  }
  return {};
}

Expected<void> Simulation::Impl::advanceFluid(double seconds, uint64_t frames) {
  const Advances::Work work{
      .advance_s = seconds, .advances = advances_->ended() + frames, .budget_s = kPiece, .substeps = options_.substepsPerSubmit};
  while (advances_->ended() < work.advances || advances_->inFlight() > 0) {
    if (auto submitted = advances_->submit(work); !submitted) return submitted;
    auto ended = advances_->finish(log_);
    if (!ended) return ended.error();
    if (!*ended) continue;
    const FluidProgress& done = advances_->last().progress;
    advanced_.substeps += done.substeps;
    advanced_.iterations += done.iterations;
    advanced_.listBuilds += done.listBuilds;
    // Time that the recorded substeps did not cover is dropped by the next advance.
    advanced_.timeDropped_s += std::max(done.timeDropped_s, done.timeLeft_s);
    frame_s_ = std::max(0.0, seconds - std::max(done.timeDropped_s, done.timeLeft_s));
    if (!done.asleep || done.substeps > 0) asleep_.reset();
  }
  return {};
}

Expected<void> Simulation::Impl::stepWhitewater() {
  Ticket counts;
  auto ran = run(whiteGraph_, [&](Graph& graph) {
    const FluidState state = fluid_->addTo(graph, {});
    counts = graph.readback(white_->addTo(graph, state, frame_s_, gravityAt(scene_, fluid_->progress().time_s)).counts);
  });
  if (!ran) return ran;
  std::array<uint32_t, kWhiteCountWords> words{};
  const auto bytes = whiteGraph_.data(counts);
  std::memcpy(words.data(), bytes.data(), std::min(bytes.size(), sizeof words));
  whiteStats_ = whitewaterStats(words);
  return {};
}

Expected<void> Simulation::Impl::run(Graph& graph, const Declare& declare) {
  graph.reset();
  declare(graph);
  if (auto compiled = graph.compile(); !compiled) return compiled;
  const auto report = graph.report();
  const bool anything = runsAnything(report);
  log_.add(report, anything);
  if (!anything) return {};
  if (auto began = context_->beginFrame(); !began) return began.error();
  if (auto prepared = graph.prepare(context_->device()); !prepared) return prepared;
  if (auto ran = context_->submit([&](VkCommandBuffer commands) { graph.record(commands); }); !ran) return ran;
  if (auto waited = context_->wait(); !waited) return waited;
  log_.add(graph.timings());
  log_.add(fluid_->passRuns(), report);
  return {};
}

Expected<void> Simulation::Impl::runUnlogged(Graph& graph, const Declare& declare) {
  const PassLog log = log_;
  auto ran = run(graph, declare);
  log_ = log;
  return ran;
}

}  // namespace rill::offline
