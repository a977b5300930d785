#pragma once
#include <cstdint>

namespace rill::view {

/// Makes simulated time follow real time in fixed steps. A machine that is too slow does not catch up: simulated time then
/// runs slower, by the factor speed().
class Clock {
 public:
  /// s; the step of rill-capture at 60 frames/s.
  static constexpr double kStep = 1.0 / 60;

  /// Adds real time during which the simulation was not paused.
  void addRealTime(double real_s);
  /// True where the next step is due.
  bool due() const { return stepsDue() >= 1; }
  double stepsDue() const { return pending_ / kStep; }
  /// Call at the start of steps; negative: some have not begun after all.
  void beginSteps(int64_t count) { pending_ -= static_cast<double>(count) * kStep; }
  /// Call at the end of a step.
  void endStep();
  /// Resets the clock: after a pause, for another scene.
  void restart() { *this = {}; }

  /// Simulated over real time in about the last second; 1 until enough is measured.
  double speed() const;
  /// True where the simulation is visibly slower than real time.
  bool slow() const { return speed() < 0.95; }

 private:
  double pending_ = 0;               // s of real time that no step covers yet
  double real_ = 0, simulated_ = 0;  // s, with exponential decay over a second
};

}  // namespace rill::view
