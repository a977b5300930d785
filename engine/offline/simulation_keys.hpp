#pragma once
// What of a scene decides a simulation, as text: so that two scenes can be compared, and the first key in which they differ be named.
#include <string>
#include <utility>
#include <vector>

#include "rill/expected.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

/// Paths as in the file ("solver.cfl", "solids[0].friction") and values, in the order of the table of keys. Keys that change no particle
/// (title, duration, probes, camera, look) are left out, and `fluid.particles`, which has become `fluid.spacing` by now.
using SimulationKeys = std::vector<std::pair<std::string, std::string>>;
/// `scene` has been through makeParticles(). The last key, "start", stands for the particles themselves: a hash of them.
SimulationKeys simulationKeys(const Scene& scene, const ParticleSet& start);

/// Empty where both are the same; else "KEY was X there and is Y here" for the first key that differs.
std::string firstDifference(const SimulationKeys& there, const SimulationKeys& here);

}  // namespace rill
