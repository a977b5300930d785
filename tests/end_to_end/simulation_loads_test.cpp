// Loads on solids and poses as probes of a simulation.
#include <cmath>

#include "end_to_end/simulation_rig.hpp"

namespace rill::offline {
namespace simulation_test {

/// Water at rest on a solid floor, with a box that moves above it.
Scene flooredTank(bool probes) {
  auto scene = parseScene(R"({
    "rill": "0.2", "domain": {"min": [0, -0.4, 0], "max": [0.4, 0.6, 0.4]}, "fluid": {"spacing": 0.05},
    "fill": [{"box": {"min": [0, 0, 0], "max": [0.4, 0.3, 0.4]}}],
    "solids": [{"name": "floor", "box": {"min": [-0.2, -0.6, -0.2], "max": [0.6, 0, 0.6]}},
               {"name": "mover", "box": {"min": [0.1, 0.4, 0.1], "max": [0.2, 0.5, 0.2]},
                "motion": [{"at": 0}, {"at": 1, "translate": [0.2, 0, 0], "rotate": [0, 1, 0, 1]}]}],
    "probes": [{"name": "load", "load": "floor"}, {"name": "dry", "load": "mover"}, {"name": "pose", "pose": "mover"}]})",
                          "floored", ".");
  EXPECT_TRUE(scene) << scene.error().message;
  if (!probes) scene->probes.clear();
  return *scene;
}

TEST(Simulation, LoadOfWaterAtRestIsItsWeight) {
  auto simulation = open({}, flooredTank(true));
  ASSERT_TRUE(simulation);
  const auto start = simulation->stats();
  ASSERT_TRUE(start);
  EXPECT_EQ(std::get<LoadValue>(start->probes[0].second).force, Double3{}) << "nothing has been measured";
  ASSERT_TRUE(simulation->advance(1));
  const auto stats = simulation->stats();
  ASSERT_TRUE(stats);
  const double weight = static_cast<double>(stats->particles) * 1000 * 0.05 * 0.05 * 0.05 * 9.81;
  const auto& load = std::get<LoadValue>(stats->probes[0].second);
  EXPECT_NEAR(load.force.y, -weight, 0.005 * weight);
  EXPECT_NEAR(load.force.x, 0, 0.005 * weight);
  EXPECT_NEAR(load.torque.z, 0, 0.005 * weight * 0.2) << "the floor's center is below the water's";
  EXPECT_EQ(std::get<LoadValue>(stats->probes[1].second).force, Double3{});
  const auto& pose = std::get<PoseValue>(stats->probes[2].second);
  EXPECT_NEAR(pose.position.x, 0.35, 1e-6);
  EXPECT_NEAR(pose.rotation.y, std::sqrt(0.5), 1e-6);
}

TEST(Simulation, MeasuringLoadsDoesNotChangeResult) {
  const auto hash = [](bool probes) {
    auto simulation = open({}, flooredTank(probes));
    EXPECT_TRUE(simulation && simulation->advance(0.3));
    return simulation->stats()->stateHash;
  };
  EXPECT_EQ(hash(true), hash(false));
}

TEST(Simulation, ResumesWithLoads) {
  auto whole = open({}, flooredTank(true));
  ASSERT_TRUE(whole && whole->advance(0.1));
  const auto checkpoint = whole->checkpoint();
  ASSERT_TRUE(checkpoint && whole->advance(0.1));
  const auto decoded = decodeCheckpoint(encodeCheckpoint(*checkpoint), "memory");
  ASSERT_TRUE(decoded);
  auto resumed = Simulation::resume(flooredTank(true), *decoded);
  ASSERT_TRUE(resumed && resumed->advance(0.1));
  const auto expected = whole->stats(), found = resumed->stats();
  ASSERT_TRUE(expected && found);
  EXPECT_EQ(found->stateHash, expected->stateHash);
  EXPECT_EQ(std::get<LoadValue>(found->probes[0].second).force, std::get<LoadValue>(expected->probes[0].second).force);
}

}  // namespace simulation_test
}  // namespace rill::offline
