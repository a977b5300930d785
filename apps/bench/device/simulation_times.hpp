#pragma once
// Frames of a dam break by the number of particles, within a time, beside what the traffic model predicts.
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/traffic/fluid_traffic.hpp"

namespace rill::bench {

/// What is known of a device before a size is run: enough to say how long it will take.
struct Pace {
  double nsPerParticleSubstep = 0;
  double substepsPerFrame = 0;  ///< with this many particles:
  double atParticles = 0;
};

struct SimulationTimes {
  uint64_t particles = 0;
  int frames = 0;  ///< measured
  double frame_ms = 0, substeps = 0, error = 0;
  std::string leftOut;  ///< why it was not run
  double ns() const { return 1e6 * frame_ms / (double(particles) * substeps); }
};

/// Counts the traffic of a fluid as this device runs it, and its pace, on about 10,000 particles.
struct SmallRun {
  FluidTraffic traffic;
  Pace pace;
};
Expected<SmallRun> smallRun(const Bench& bench);

/// Runs `count` particles for at most about `budget_s`; leaves them out where even two frames would take longer, or need more than
/// `availableBytes` of device memory.
Expected<SimulationTimes> timeSimulation(const Bench& bench, uint32_t count, const Pace& pace, uint64_t availableBytes, double budget_s);

}  // namespace rill::bench
