#include "view/playback.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace rill::view {

Expected<bool> Playback::advance(Runner& runner, const Frame& frame) {
  using Now = std::chrono::steady_clock;
  const bool first = !std::exchange(started_, true);
  const bool single = runner.betweenSteps() && singles_ > 0;  // after the step in progress
  if (single) --singles_;
  if (frame.lockstep) {
    if ((frame.paused && !single) || first) return false;
    if (auto ran = runner.step(); !ran) return ran.error();
    return finished(runner, frame);
  }
  if (!frame.paused) clock_.addRealTime(frame.passed_s);
  bool ended = false;
  if (single) {
    if (auto ran = runner.advancePiece(frame.budget_s); !ran) return ran.error();
    if (runner.betweenSteps()) return finished(runner, frame);
  }
  const bool queues = frame.queues && !frame.paused && !measuresIn(frame) && singles_ == 0;
  const bool staysBusy = queues && runner.mayStayBusy();
  const Now::time_point begin = Now::now();
  for (double left = frame.budget_s; left > 0; left = frame.budget_s - std::chrono::duration<double>(Now::now() - begin).count()) {
    if (runner.betweenSteps()) {
      if (frame.paused || !clock_.due()) return ended;
    }
    const bool more = queues && clock_.stepsDue() >= (runner.betweenSteps() ? 2 : 1);
    // Where none may be left in flight, two pieces are waited for in this frame.
    auto step = counted(runner, [&] { return runner.advancePiece(staysBusy ? left : 0.5 * left, more); });
    if (!step) return step;
    if (!*step) continue;
    ended = true;
    if (auto done = finished(runner, frame); !done) return done;
  }
  if (staysBusy) return ended;
  auto step = counted(runner, [&] { return runner.settle(); });
  if (!step || !*step) return step ? Expected<bool>(ended) : step;
  return finished(runner, frame);
}

template <class Work>
Expected<bool> Playback::counted(Runner& runner, Work&& work) {
  const uint64_t steps = runner.steps(), begun = runner.begun();
  if (auto done = work(); !done) return done.error();
  clock_.beginSteps(static_cast<int64_t>(runner.begun() - begun));
  if (runner.steps() == steps) return false;
  clock_.endStep();
  return true;
}

void Playback::addBody(const Runner& runner, uint32_t solid) {
  const auto bodies = runner.fluid().bodies();
  const auto body = std::ranges::find(bodies, solid, &BodyMotion::solid);
  if (body == bodies.end()) return;
  if (histories_.body.solid != solid) histories_.body = {.solid = solid};
  histories_.body.load_N.add(runner.fluid().solidLoads()[solid].force.y);
  histories_.body.height_m.add(body->center.y);
}

void Playback::addFlows(const Runner& runner) {
  constexpr double kSmoothing = 0.1;  // weight of a step: layers leave a mouth whole
  const Scene& scene = runner.scene();
  if (!hasFlows(scene)) return;
  uint64_t emitted = 0;
  for (const FlowReading& reading : runner.fluid().emitted()) emitted += reading.particles;
  const uint64_t present = runner.fluid().count();
  if (!histories_.flows) histories_.flows = FlowHistory{.emitted = emitted, .present = present};
  FlowHistory& flows = *histories_.flows;
  const double litersPerSecond = 1000 * std::pow(scene.fluid.spacing, 3) / Clock::kStep;
  const double in = static_cast<double>(emitted - std::min(flows.emitted, emitted));
  const double out = std::max(in - (static_cast<double>(present) - static_cast<double>(flows.present)), 0.0);  // fluid may be thrown, too
  const auto add = [&](History& history, double particles) {
    const double before = history.values().empty() ? 0 : history.values().back();
    history.add(before + kSmoothing * (particles * litersPerSecond - before));
  };
  add(flows.in_L_s, in);
  add(flows.out_L_s, out);
  flows.emitted = emitted;
  flows.present = present;
}

Expected<bool> Playback::finished(Runner& runner, const Frame& frame) {
  const StepFigures& step = runner.last();
  histories_.particles.add(runner.fluid().count());
  histories_.substeps.add(step.substeps);
  histories_.iterations.add(step.iterations);
  histories_.wall_ms.add(1e3 * step.seconds);
  addFlows(runner);
  addBody(runner, frame.body);
  if (!runner.betweenSteps() || !measuresIn(frame)) return true;
  measured_s_ = frame.now_s;
  auto stats = runner.measure();
  if (!stats) return stats.error();
  stats_ = *stats;
  histories_.error.add(100 * stats->densityErrorMean);
  return true;
}

}  // namespace rill::view
