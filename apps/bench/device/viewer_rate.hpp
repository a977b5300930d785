#pragma once
#include <string>

#include "bench/bench.hpp"

namespace rill::bench {

struct ViewerRate {
  double frame_ms = 0, frame_p95_ms = 0;
  std::string leftOut;  ///< why it was not run
};

/// Runs rill-view for some frames in a window, if there is a display and the program lies beside this one or in PATH.
ViewerRate viewerRate(const Bench& bench, const std::string& scene, uint32_t frames);

}  // namespace rill::bench
