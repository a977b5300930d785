#include "view/playback.hpp"

#include <chrono>
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
  const Now::time_point begin = Now::now();
  for (double left = frame.budget_s; left > 0; left = frame.budget_s - std::chrono::duration<double>(Now::now() - begin).count()) {
    if (runner.betweenSteps()) {
      if (frame.paused || !clock_.due()) return ended;
      clock_.beginStep();
    }
    if (auto ran = runner.advancePiece(left); !ran) return ran.error();
    if (!runner.betweenSteps()) continue;
    clock_.endStep();
    ended = true;
    if (auto done = finished(runner, frame); !done) return done;
  }
  return ended;
}

Expected<bool> Playback::finished(Runner& runner, const Frame& frame) {
  const StepFigures& step = runner.last();
  histories_.particles.add(runner.fluid().count());
  histories_.substeps.add(step.substeps);
  histories_.iterations.add(step.iterations);
  histories_.wall_ms.add(1e3 * step.wall_s);
  if (!frame.measureEvery_s || frame.now_s - measured_s_ < *frame.measureEvery_s) return true;
  measured_s_ = frame.now_s;
  auto stats = runner.measure();
  if (!stats) return stats.error();
  stats_ = *stats;
  histories_.error.add(100 * stats->densityErrorMean);
  return true;
}

}  // namespace rill::view
