#pragma once
// What of a scene is simulated for a displayed frame, and the figures that are kept of it.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "view/clock.hpp"
#include "view/runner.hpp"

namespace rill::view {

/// The last figures of a kind, one a step.
class History {
 public:
  static constexpr size_t kMaxEntries = 240;  ///< four seconds of simulated time
  void add(double value) {
    if (values_.size() == kMaxEntries) values_.erase(values_.begin());
    values_.push_back(static_cast<float>(value));
  }
  void clear() { values_.clear(); }
  const std::vector<float>& values() const { return values_; }

 private:
  std::vector<float> values_;
};

struct Histories {
  History particles, substeps, iterations, wall_ms, error;
  std::map<std::string, History, std::less<>> passes;
  uint64_t passesOf = UINT64_MAX;  ///< the step whose times were added last
};

class Playback {
 public:
  /// A displayed frame.
  struct Frame {
    double passed_s = 0;  ///< real time since the last one
    double now_s = 0;     ///< real time
    double budget_s = 0;  ///< real time that simulation may take
    bool paused = false;
    bool lockstep = false;                 ///< one step a frame, whatever that takes, but for the first
    std::optional<double> measureEvery_s;  ///< figures of the fluid are wanted, so often
  };
  /// Whether a step came to its end.
  Expected<bool> advance(Runner& runner, const Frame& frame);
  void oneStep() { ++singles_; }  ///< one more, in the next frames, paused or not
  /// After anything that begins a simulation at its start.
  void restart() { *this = {}; }

  Histories& histories() { return histories_; }
  const std::optional<FluidStats>& stats() const { return stats_; }
  double speed() const { return clock_.speed(); }  ///< simulated over real time

 private:
  Expected<bool> finished(Runner& runner, const Frame& frame);

  Clock clock_;
  Histories histories_;
  std::optional<FluidStats> stats_;
  double measured_s_ = -1;
  uint32_t singles_ = 0;
  bool begun_ = false;
};

}  // namespace rill::view
