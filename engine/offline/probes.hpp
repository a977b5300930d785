#pragma once
#include <memory>
#include <span>

#include "offline/neighbor_counter.hpp"
#include "rill/scene.hpp"

namespace rill::offline {

/// Evaluates probes on particles in host memory. Values are in m, relative to the domain's minimum (to the scene's origin without a
/// domain).
class ProbeReader {
 public:
  /// `positions`: m, relative to `origin` (m); they must outlive the reader.
  ProbeReader(const Scene& scene, std::span<const Float3> positions, const Double3& origin);
  ~ProbeReader();

  /// Height of the fluid column above the floor at x, z (m, scene coordinates): the highest particle within one spacing of the vertical
  /// line and below the first empty bin of 1.5 spacings, plus half a spacing; 0 without fluid.
  double level(double x, double z) const;

  /// Position of the farthest particle along the axis with at least five neighbors within the smoothing length, plus half a spacing; 0
  /// without one.
  double front(Axis axis) const;

 private:
  std::span<const Float3> positions_;
  double spacing_, smoothing_;
  Double3 shift_;                                       ///< added to positions to make them relative to the domain's minimum, m
  Double3 minimum_;                                     ///< of the domain, m
  mutable std::unique_ptr<NeighborCounter> neighbors_;  ///< created by front()
};

}  // namespace rill::offline
