#pragma once
// What surfaces are measured against: aims of error and of time for spheres of ten pixels at 1024x768.
#include <span>
#include <string>
#include <vector>

#include "bench/report.hpp"

namespace rill::bench {

/// What a method reached on a shape.
struct SurfaceFigures {
  std::string picture, shape, method;
  double ms = 0, smoothing_ms = 0;     ///< the whole chain; without what comes before the depth of spheres
  double mean = 0, p95 = 0, edge = 0;  ///< degrees
  double overlap = 0;                  ///< of silhouettes
  double flicker = 0;                  ///< degrees a frame; of the moving wave alone
};

inline constexpr const char* kMovingWave = "moving wave";  ///< a shape, of pictures of any size

/// A row an aim that was measured. What is worse than its band is among the `failures`; times have none, since they are the machine's.
/// `whole`: nothing was left out, and an aim without a figure is a failure, too.
Table judgedSurfaces(std::span<const SurfaceFigures> all, bool whole, std::vector<std::string>& failures);

}  // namespace rill::bench
