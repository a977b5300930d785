#pragma once
#include <memory>
#include <span>

#include "offline/neighbor_counter.hpp"
#include "rill/scene.hpp"

namespace rill::offline {

/// Measures a scene's probes on particles that were read back. Values are relative to the domain's minimum (the scene's zero where it has
/// none).
class ProbeReader {
 public:
  /// `positions` are relative to `origin` (both in m) and outlive the reader.
  ProbeReader(const Scene& scene, std::span<const Float3> positions, const double (&origin)[3]);
  ~ProbeReader();

  double measure(const Probe& probe) const;

  /// Height of the wet column over the floor at x, z (scene coordinates): among particles within one spacing of the vertical line, up from
  /// the floor in bins of 1.5 spacings until one is empty; the highest below that plus half a spacing; 0 where dry.
  double level(double x, double z) const;

  /// The farthest particle along the axis with at least five neighbors within the smoothing length, plus half a spacing the same way. 0
  /// where there is none.
  double front(Axis axis) const;

 private:
  std::span<const Float3> positions_;
  double spacing_, smoothing_;
  double shift_[3];                                     ///< from a position to one relative to the domain's minimum
  double minimum_[3];                                   ///< of the domain, m
  mutable std::unique_ptr<NeighborCounter> neighbors_;  ///< made when a front is asked for
};

}  // namespace rill::offline
