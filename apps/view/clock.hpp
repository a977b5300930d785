#pragma once
#include <cstdint>

namespace rill::view {

/// Simulated time follows real time in steps of one length. What the machine has not simulated when the next step is due is not caught up
/// with: time then goes slower, and speed() says by how much.
class Clock {
 public:
  /// s; the steps of rill-capture at 60 frames a second.
  static constexpr double kStep = 1.0 / 60;

  /// Real time went by while the simulation was to run.
  void passed(double real_s);
  /// Whether a step is to begin now.
  bool due() const { return owed_ >= kStep; }
  /// A step has begun.
  void begun() { owed_ -= kStep; }
  /// A step was simulated to its end.
  void finished();
  /// Forgets what is owed and what was measured: after a pause, another scene.
  void restart() { *this = {}; }

  /// Simulated over real time, over about the last second; 1 as long as nothing is known.
  double speed() const;
  /// Whether that differs from real time by what a person would see.
  bool slow() const { return speed() < 0.95; }

 private:
  double owed_ = 0;                  // s
  double real_ = 0, simulated_ = 0;  // s, fading with a time constant of a second
};

}  // namespace rill::view
