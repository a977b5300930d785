#pragma once
// Simulates for a displayed frame, and keeps the history of figures for the plots.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "view/clock.hpp"
#include "view/runner.hpp"

namespace rill::view {

/// The last values of a figure, one per step.
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
  uint64_t passesOf = UINT64_MAX;  ///< the last step whose times were added
};

class Playback {
 public:
  /// Parameters of a displayed frame.
  struct Frame {
    double passed_s = 0;  ///< real time since the last one
    double now_s = 0;     ///< real time
    double budget_s = 0;  ///< real time available for simulation
    bool paused = false;
    bool lockstep = false;                 ///< one step per frame except the first, however long it takes
    std::optional<double> measureEvery_s;  ///< interval between measurements of the fluid, if any
    bool queues = true;                    ///< the next step may be submitted before the last is known to be complete
  };
  /// Simulates for a frame. True where a step was completed.
  Expected<bool> advance(Runner& runner, const Frame& frame);
  void oneStep() { ++singles_; }  ///< requests a step in the next frames, even when paused
  /// Call after a simulation was started from the beginning.
  void restart() { *this = {}; }

  Histories& histories() { return histories_; }
  const std::optional<FluidStats>& stats() const { return stats_; }
  double speed() const { return clock_.speed(); }  ///< simulated over real time

 private:
  bool measuresIn(const Frame& frame) const { return frame.measureEvery_s && frame.now_s - measured_s_ >= *frame.measureEvery_s; }
  Expected<bool> finished(Runner& runner, const Frame& frame);
  /// Does `work`, which ends at most one step, and tells the clock. True where a step was completed.
  template <class Work>
  Expected<bool> counted(Runner& runner, Work&& work);

  Clock clock_;
  Histories histories_;
  std::optional<FluidStats> stats_;
  double measured_s_ = -1;
  uint32_t singles_ = 0;
  bool started_ = false;
};

}  // namespace rill::view
