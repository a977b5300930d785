#pragma once
// A trial with several fluids.
#include <string>
#include <vector>

#include "fluid/rig.hpp"

namespace rill::test {
namespace fluids_test {

using FluidsTest = FluidTest;

/// A jittered block in a corner, of fluids of these densities that are mixed at random.
inline Trial mixture(const std::vector<double>& densities, unsigned seed = 5) {
  Trial t = trial();
  for (const double density : densities) {
    const std::string name = "fluid " + std::to_string(t.scene.fluids.size());
    t.scene.fluids.push_back({.name = name, .density = density});
  }
  setWalls(t, {1, 1, 1});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 0.4, seed, glm::dvec3(-0.2));
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(static_cast<uint8_t>((i * 7919 + seed) % densities.size()));
  return t;
}

}  // namespace fluids_test
}  // namespace rill::test
