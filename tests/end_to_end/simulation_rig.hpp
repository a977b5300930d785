#pragma once
// A small dam break, opened as a simulation.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>

#include "rill/offline.hpp"

namespace rill::offline {
namespace simulation_test {

inline Scene dam() {
  auto scene = parseScene(R"({
    "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
    "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}],
    "probes": [{"name": "front", "front": "+x"}]})",
                          "dam", ".");
  EXPECT_TRUE(scene);
  return *scene;
}

inline std::optional<Simulation> open(const Options& options = {}, Scene scene = dam()) {
  auto simulation = Simulation::open(std::move(scene), options);
  if (!simulation) {
    ADD_FAILURE() << simulation.error().message;
    return {};
  }
  return std::move(*simulation);
}

inline uint64_t hashAfter(const Options& options, int frames) {
  auto simulation = open(options);
  if (!simulation) return 0;
  for (int k = 0; k < frames; ++k) EXPECT_TRUE(simulation->advance(1.0 / 60));
  const auto stats = simulation->stats();
  EXPECT_TRUE(stats);
  return stats ? stats->stateHash : 0;
}

}  // namespace simulation_test
}  // namespace rill::offline
