#pragma once
// Simulations with film effects.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "rill/offline.hpp"

namespace rill::offline {
namespace film_test {

inline Scene sceneOf(const std::string& text) {
  auto scene = parseScene(text, "film", ".");
  EXPECT_TRUE(scene) << scene.error().message;
  return *scene;
}

inline Simulation opened(const Scene& scene, const Film& film = {}, double orbit = 0) {
  auto made = Simulation::open(scene, {.orbit_degPerS = orbit, .film = film, .validation = true});
  EXPECT_TRUE(made) << made.error().message;
  return *std::move(made);
}

inline Scene dam(double spacing = 0.04) {
  return sceneOf(R"({"rill": "0.2", "domain": {"min": [0, 0, 0], "max": [1, 0.8, 0.3]}, "fluid": {"spacing": )" + std::to_string(spacing) +
                 R"(}, "fill": [{"box": {"min": [0, 0, 0], "max": [0.4, 0.5, 0.3]}}]})");
}

}  // namespace film_test
}  // namespace rill::offline
