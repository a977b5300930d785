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
  explicit History(size_t maxEntries = 240) : maxEntries_(maxEntries) {}  ///< by default four seconds of simulated time
  void add(double value) {
    if (values_.size() == maxEntries_) values_.erase(values_.begin());
    values_.push_back(static_cast<float>(value));
  }
  void clear() { values_.clear(); }
  const std::vector<float>& values() const { return values_; }

 private:
  size_t maxEntries_;
  std::vector<float> values_;
};

/// Of the body that the panel shows, over ten seconds of simulated time.
struct BodyHistory {
  uint32_t solid = 0;                                      ///< its index
  History load_N = History(600), height_m = History(600);  ///< vertical load of the fluid; of its center of mass
};

/// Of particles that come and go, over ten seconds of simulated time.
struct FlowHistory {
  History in_L_s = History(600), out_L_s = History(600);  ///< from emitters; through drains and open sides
  uint64_t emitted = 0, present = 0;                      ///< particles after the last step
};

struct Histories {
  History particles, substeps, iterations, wall_ms, error;
  BodyHistory body;
  std::optional<FlowHistory> flows;  ///< where particles come and go
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
    uint32_t body = 0;                     ///< index of the solid whose history is kept, if it is a body
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
  void addFlows(const Runner& runner);
  void addBody(const Runner& runner, uint32_t solid);
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
