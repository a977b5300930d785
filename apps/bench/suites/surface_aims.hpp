#pragma once
// Aims for error and time of surface methods, for sphere radii of ten pixels at 1024x768.
#include <span>
#include <string>
#include <vector>

#include "bench/report.hpp"

namespace rill::bench {

/// Results of a method on a shape.
struct SurfaceFigures {
  std::string picture, shape, method;
  double ms = 0, smoothing_ms = 0;     ///< all passes; passes after the sphere depth
  double mean = 0, p95 = 0, edge = 0;  ///< degrees
  double iou = 0;                      ///< intersection over union of silhouettes
  double flicker = 0;                  ///< degrees per frame; moving wave only
};

inline constexpr const char* kMovingWave = "moving wave";  ///< shape name; compared at any picture size

/// One row per measured aim. Adds a failure for each figure outside its band; times have no band, since they depend on the machine.
/// `complete`: all cases ran, so an aim without a figure is a failure too.
Table surfaceAimTable(std::span<const SurfaceFigures> all, bool complete, std::vector<std::string>& failures);

}  // namespace rill::bench
