#pragma once
// Values of a scene's probes.
#include <string>
#include <utility>
#include <vector>

#include "offline/probes.hpp"
#include "rill/fluid.hpp"
#include "rill/offline.hpp"
#include "shape/pose.hpp"

namespace rill::offline {

PoseValue valueOf(const Pose& pose);

/// Loads, pressures and flows are means over the last advance: their state before it is kept.
class ProbeValues {
 public:
  /// The scene must outlive it.
  explicit ProbeValues(const Scene& scene) : scene_(scene) {}

  /// Call it before each advance.
  void beginAdvance(const Fluid& fluid);
  /// Name and value of each probe. `time_s`: of the poses; `advanced_s`: simulated time that the last advance took.
  std::vector<std::pair<std::string, ProbeValue>> read(const Fluid& fluid, const ProbeReader& reader, double time_s,
                                                       double advanced_s) const;

 private:
  struct Moment;
  ProbeValue valueOf(const Probe& probe, const ProbeReader& reader, const Moment& now) const;
  size_t solidNamed(const std::string& name) const;
  PoseValue poseOf(size_t solid, const Moment& now) const;
  PressureValue pressureAt(const Probe& probe, const Moment& now) const;
  FlowValue flowThrough(const std::string& name, const Moment& now) const;
  LoadValue loadOn(size_t solid, const Moment& now) const;

  const Scene& scene_;
  // Before the last advance.
  std::vector<SolidLoad> loads_;
  std::vector<PressureReading> pressures_;
  std::vector<double> volumes_;  ///< m^3, through emitters, then drains
};

}  // namespace rill::offline
