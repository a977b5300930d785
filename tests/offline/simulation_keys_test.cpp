// The keys that a checkpoint compares with a scene's.
#include "offline/simulation_keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/flat_meshes.hpp"

namespace rill::test {
namespace {

std::string valueOf(const SimulationKeys& keys, const std::string& key) {
  const auto found = std::ranges::find(keys, key, &SimulationKeys::value_type::first);
  return found == keys.end() ? "absent" : found->second;
}

Scene withFlows() {
  Scene scene;
  scene.fluid.spacing = 0.1;
  scene.emitters = {{.name = "tap", .mouth = DiscMouth{.radius = 0.25}, .flow = 0.5},
                    {.mouth = RectMouth{.size = {0.5, 0.25}}, .speed = 2, .until = 3}};
  scene.drains = {{.name = "plug", .shape = SphereShape{{1, 2, 3}, 0.5}, .from = 1}};
  scene.probes = {{.name = "rate", .flow = "tap"}};
  return scene;
}

TEST(SimulationKeys, HaveEmittersAndDrains) {
  const SimulationKeys keys = simulationKeys(withFlows(), {});
  EXPECT_EQ(valueOf(keys, "emitters[0].disc.radius"), "0.25");
  EXPECT_EQ(valueOf(keys, "emitters[0].flow"), "0.5");
  EXPECT_EQ(valueOf(keys, "emitters[0].until"), "not set");
  EXPECT_EQ(valueOf(keys, "emitters[0].rect.size"), "absent");
  EXPECT_EQ(valueOf(keys, "emitters[1].rect.size"), "[0.5,0.25]");
  EXPECT_EQ(valueOf(keys, "emitters[1].until"), "3");
  EXPECT_EQ(valueOf(keys, "drains[0].sphere.center"), "[1,2,3]");
  EXPECT_EQ(valueOf(keys, "solver.time_step"), "auto");
}

TEST(SimulationKeys, FindADifferentFlowButNoOtherName) {
  const SimulationKeys keys = simulationKeys(withFlows(), {});
  Scene other = withFlows();
  other.emitters[0].name = "spout";
  other.probes[0].flow = "spout";
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "");
  other.emitters[0].until = 2;
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "emitters[0].until: found 2, expected not set");
  other = withFlows();
  std::get<RectMouth>(other.emitters[1].mouth).size.second = 1;
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "emitters[1].rect.size: found [0.5,1], expected [0.5,0.25]");
  other = withFlows();
  other.drains.clear();
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "drains[0].sphere.center: not set, expected [1,2,3]");
}

TEST(SimulationKeys, HaveTheMeshOfAMouthAndItsPlaceButNotItsFile) {
  Scene scene = withFlows();
  MeshMouth mouth = mouthOf(cornerMesh(0.1));
  mouth.file = "here.obj";
  mouth.translation = {1, 2, 3};
  scene.emitters[0].mouth = mouth;
  const SimulationKeys keys = simulationKeys(scene, {});
  EXPECT_EQ(valueOf(keys, "emitters[0].mesh.translation"), "[1,2,3]");
  mouth.file = "there.obj";
  scene.emitters[0].mouth = mouth;
  EXPECT_EQ(firstDifference(keys, simulationKeys(scene, {})), "");
  mouth.rotation = {1, 0, 0, 0};
  scene.emitters[0].mouth = mouth;
  EXPECT_EQ(firstDifference(keys, simulationKeys(scene, {})), "emitters[0].mesh.rotation: found [1,0,0,0], expected [0,0,0,1]");
  MeshMouth other = mouthOf(cornerMesh(0.2));
  other.translation = mouth.translation;
  scene.emitters[0].mouth = other;
  EXPECT_EQ(firstDifference(keys, simulationKeys(scene, {})).substr(0, 24), "emitters[0].mesh: found ");
}

TEST(SimulationKeys, FindADifferentInterfaceButNoOtherNames) {
  Scene scene;
  scene.fluids = {{.name = "water"}, {.name = "oil"}, {.name = "tar"}};
  scene.interfaces = {{.between = {"oil", "water"}, .tension = 0.02}};
  const SimulationKeys keys = simulationKeys(scene, {});
  EXPECT_EQ(valueOf(keys, "interfaces[0].between"), "fluids 0 and 1");
  Scene other = scene;
  other.fluids[1].name = "fat";
  other.interfaces[0].between = {"water", "fat"};
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "");
  other.interfaces[0].between = {"water", "tar"};
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "interfaces[0].between: found fluids 0 and 2, expected fluids 0 and 1");
  other = scene;
  other.interfaces[0].tension = 0.03;
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "interfaces[0].tension: found 0.03, expected 0.02");
  other.interfaces.clear();
  EXPECT_NE(firstDifference(keys, simulationKeys(other, {})), "");
}

Scene withFluids() {
  Scene scene = withFlows();
  scene.fluids = {{.name = "water"}, {.name = "oil", .density = 900, .color = Double3{1, 0, 0}}};
  scene.emitters[1].fluid = "oil";
  return scene;
}

TEST(SimulationKeys, HaveFluidsAndTheFluidOfEmittersByItsIndex) {
  const SimulationKeys keys = simulationKeys(withFluids(), {});
  EXPECT_EQ(valueOf(keys, "fluids[1].density"), "900");
  EXPECT_EQ(valueOf(keys, "fluids[1].color"), "absent") << "no bit depends on it";
  EXPECT_EQ(valueOf(keys, "emitters[0].fluid"), "0");
  EXPECT_EQ(valueOf(keys, "emitters[1].fluid"), "1");
  EXPECT_EQ(valueOf(simulationKeys(withFlows(), {}), "emitters[1].fluid"), "absent");
  Scene other = withFluids();
  other.fluids[1].name = other.emitters[1].fluid = "petrol";
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "");
  other.emitters[0].fluid = "petrol";
  EXPECT_EQ(firstDifference(keys, simulationKeys(other, {})), "emitters[0].fluid: found 1, expected 0");
}

TEST(SimulationKeys, FindOtherFluidsOfParticles) {
  ParticleSet start{.positions = {{0, 0, 0}, {1, 0, 0}}, .velocities = {{0, 0, 0}, {0, 0, 0}}, .fluids = {0, 1}};
  const SimulationKeys keys = simulationKeys(withFluids(), start);
  EXPECT_EQ(firstDifference(keys, simulationKeys(withFluids(), start)), "");
  start.fluids = {1, 0};
  EXPECT_NE(firstDifference(keys, simulationKeys(withFluids(), start)).find("start: the initial particles differ"), std::string::npos);
}

}  // namespace
}  // namespace rill::test
