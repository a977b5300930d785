#pragma once
// The scene keys that affect a simulation, as text, to compare two scenes and name the first difference.
#include <string>
#include <utility>
#include <vector>

#include "rill/expected.hpp"
#include "rill/particles.hpp"
#include "rill/scene.hpp"

namespace rill {

/// Key paths as in the file ("solver.cfl", "solids[0].friction") and values, in the order of the field table. Without keys that do not
/// affect particles (title, duration, probes, camera, look) and `fluid.particles`, from which `fluid.spacing` was computed.
using SimulationKeys = std::vector<std::pair<std::string, std::string>>;
/// `scene` and `start` must come from makeParticles(). The last key, "start", is a hash of the particles.
SimulationKeys simulationKeys(const Scene& scene, const ParticleSet& start);

/// Describes the first difference: "KEY: found Y, expected X". Empty without a difference. `expected` are the keys of the checkpoint.
std::string firstDifference(const SimulationKeys& expected, const SimulationKeys& found);

}  // namespace rill
