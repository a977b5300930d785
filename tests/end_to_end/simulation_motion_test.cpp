// How fluids move by default: at rest, from overlapping fills, in free fall, in time steps that are too long.
#include <algorithm>
#include <cmath>

#include "end_to_end/simulation_rig.hpp"

namespace rill::offline {
namespace simulation_test {

/// RMS speed in a tank, 16 layers deep, after two seconds at rest, m/s.
double restingSpeed(std::optional<double> artificialViscosity) {
  auto scene = parseScene(R"({
    "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [0.4, 1.2, 0.4]}, "fluid": {"spacing": 0.05},
    "fill": [{"box": {"min": [0, 0, 0], "max": [0.4, 0.8, 0.4]}}]})",
                          "tank", ".");
  EXPECT_TRUE(scene);
  scene->solver.artificial_viscosity = artificialViscosity;
  auto simulation = open({}, *scene);
  if (!simulation) return 0;
  EXPECT_TRUE(simulation->advance(2));
  const auto stats = simulation->stats();
  EXPECT_TRUE(stats);
  if (!stats) return 0;
  EXPECT_EQ(stats->artificialViscosity_Pa_s > 0, artificialViscosity != 0.0);
  EXPECT_LT(stats->densityErrorMean, artificialViscosity == 0.0 ? 0.0015 : 0.001);
  return std::sqrt(2 * stats->kinetic_J / (1000 * 0.4 * 0.8 * 0.4));
}

TEST(Simulation, WaterAtRestStaysAtRest) {
  const double still = restingSpeed({}), undamped = restingSpeed(0.0);
  EXPECT_LT(still, 0.04);
  EXPECT_LT(still, undamped);
  EXPECT_LT(undamped, 0.2) << "0.16 was measured: what the lattice sets free as it gives way";
}

// A fill that is not a multiple of the spacing: its last layer overlaps the one before. Separating them must not add speed
// or pressure.
// Settling takes away what is too dense; pairs that are still close part in the first frame, by artificial pressure.
TEST(Simulation, OverlappingFillsStartWithoutBurst) {
  struct Case {
    double tensile, speed;  // 0.38 and 1.03 m/s were measured; falling gives 0.16, and parting without settling 2.6
  };
  for (const Case& c : {Case{0, 0.45}, Case{FluidSettings{}.tensile, 1.15}}) {
    auto scene = parseScene(R"({
      "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1.4, 1.6, 0.5]}, "fluid": {"spacing": 0.0523},
      "fill": [{"box": {"min": [0, 0, 0], "max": [0.7, 1.2, 0.5]}}]})",
                            "overlapping", ".");
    ASSERT_TRUE(scene);
    scene->fluid.tensile = c.tensile;
    auto simulation = open({}, *scene);
    ASSERT_TRUE(simulation);
    const auto before = simulation->stats();
    ASSERT_TRUE(before);
    EXPECT_GT(before->densityErrorMean, 0.01) << "it does overlap";
    ASSERT_TRUE(simulation->advance(1.0 / 60));
    const auto after = simulation->stats();
    ASSERT_TRUE(after);
    EXPECT_LT(after->maxSpeed, c.speed) << c.tensile;
    EXPECT_LT(after->densityErrorMean, 0.001) << c.tensile;
    EXPECT_LT(after->kinetic_J + after->potential_J, 1.02 * before->potential_J) << "it rises by what was too dense";
  }
}

// In free fall the distance between drops changes neither the substeps nor the speed.
TEST(Simulation, DistantDropsFallLikeOne) {
  const auto fall = [](const std::string& fills) {
    auto scene = parseScene(R"({"rill": "0.1", "fluid": {"spacing": 0.02}, "fill": [)" + fills + "]}", "drops", ".");
    EXPECT_TRUE(scene);
    auto simulation = open({}, *scene);
    if (!simulation) return offline::Stats{};
    EXPECT_TRUE(simulation->advance(0.1));
    const auto stats = simulation->stats();
    EXPECT_TRUE(stats);
    return stats ? *stats : offline::Stats{};
  };
  const std::string drop = R"({"sphere": {"center": [0, 0, 0], "radius": 0.1}})";
  const auto one = fall(drop), two = fall(drop + R"(, {"sphere": {"center": [0, 300, 0], "radius": 0.1}})");
  EXPECT_EQ(two.particles, 2 * one.particles);
  EXPECT_EQ(two.timeDropped_s, 0);
  EXPECT_LT(two.substeps, 1.5 * one.substeps) << "one drop of all of it is a quarter higher";
  EXPECT_NEAR(two.maxSpeed, 0.981, 0.01);
}

// A time step in which a column collapses under its weight adds energy; the solver must not take one.
TEST(Simulation, TimeStepIsLimitedByFluid) {
  Scene tall;
  tall.fluid.spacing = 0.05;
  tall.domain = Domain{{0, 0, 0}, {0.6, 3, 0.2}};
  Fill fill;
  fill.shape = BoxShape{{0, 0, 0}, {0.3, 2, 0.2}};
  tall.fill.push_back(fill);
  tall.solver.time_step = 1;
  tall.solver.tolerance = 0.1;
  tall.solver.cfl = 10;
  for (const uint32_t iterations : {1u, 3u}) {
    tall.solver.iterations = iterations;
    auto simulation = open({}, tall);
    ASSERT_TRUE(simulation);
    const auto warnings = simulation->warnings();
    EXPECT_TRUE(
        std::ranges::any_of(warnings, [](const std::string& text) { return text.starts_with("solver.time_step 1 s is more than"); }));
    const auto start = simulation->stats();
    ASSERT_TRUE(start);
    for (int frame = 0; frame < 30; ++frame) {
      ASSERT_TRUE(simulation->advance(1.0 / 60));
      const auto stats = simulation->stats();
      ASSERT_TRUE(stats);
      EXPECT_LE(stats->kinetic_J + stats->potential_J, 1.02 * (start->kinetic_J + start->potential_J)) << iterations << " at " << frame;
    }
  }
}

}  // namespace simulation_test
}  // namespace rill::offline
