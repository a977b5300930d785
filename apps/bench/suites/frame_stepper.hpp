#pragma once
// Simulations that advance frame by frame, for times of frames.
#include <optional>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/suites/feature_cases.hpp"

namespace rill::bench {

constexpr int kWarmUp = 2;  ///< frames of shader compilation and a wrong estimate of the number of substeps

/// A simulation that advances frame by frame, so that several can be interleaved.
class FrameStepper {
 public:
  static Expected<FrameStepper> open(const Bench& bench, const std::string& scene, const Overrides& overrides,
                                     const Feature* feature = nullptr);

  /// Advances one frame and returns its wall time in ms, including figures if enabled.
  Expected<double> frame(double seconds);
  Expected<offline::Stats> stats() { return simulation_->stats(); }

 private:
  std::optional<offline::Simulation> simulation_;
  bool measuresFigures_ = false;
};

/// How often each pass was recorded.
Json passesJson(const std::vector<offline::PassTime>& passes);

}  // namespace rill::bench
