#pragma once
// What surfaces are measured against: aims of error and of time for spheres of ten pixels at 1024x768.
#include <span>

#include "bench/report.hpp"

namespace rill::bench {

/// What a method reached on a shape.
struct SurfaceFigures {
  std::string picture, shape, method;
  double ms = 0, smoothing_ms = 0;     ///< the whole chain; without what comes before the depth of spheres
  double mean = 0, p95 = 0, edge = 0;  ///< degrees
  double overlap = 0;                  ///< of silhouettes
};

/// A row an aim that was measured. What is worse than its band is among the `failures`; times have none, since they are the machine's.
Table judgedSurfaces(std::span<const SurfaceFigures> all, std::vector<std::string>& failures);

}  // namespace rill::bench
