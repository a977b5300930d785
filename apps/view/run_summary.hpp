#pragma once
// The figures that a run with --frames or a script prints at its end.
#include <cstdint>
#include <string>
#include <vector>

#include "view/runner.hpp"

namespace rill::view {

class RunSummary {
 public:
  void addFrame(double seconds) { frames_ms_.push_back(1e3 * seconds); }
  /// Ends the step in progress and prints to standard output. `frames`: displayed, in `wall_s` seconds.
  Expected<void> print(const std::string& scene, uint64_t frames, double wall_s, Runner& runner);

 private:
  std::vector<double> frames_ms_;
};

}  // namespace rill::view
