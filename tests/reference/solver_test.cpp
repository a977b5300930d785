// Complete substeps of the reference solver.
#include <gtest/gtest.h>

#include <limits>

#include "reference/cloud.hpp"

namespace rill::reference {
namespace {

constexpr double kTankSpacing = 0.05, kNaN = std::numeric_limits<double>::quiet_NaN();

void run(ReferenceSolver& solver, double dt, int steps) {
  solver.begin(dt);
  for (int step = 0; step < steps; ++step) solver.substep(dt, dt);
}

double leastDistance(const ReferenceSolver& solver) {
  double least = 1e9;
  for (size_t i = 0; i < solver.size(); ++i)
    for (size_t j = 0; j < i; ++j) least = std::min(least, glm::length(solver.state.position[i] - solver.state.position[j]));
  return least;
}

TEST(ReferenceSolver, FullBoxWithoutGravityStaysAtRest) {
  for (const KernelChoice kernel : {KernelChoice::Wendland, KernelChoice::Poly6Spiky}) {
    for (const bool tabulated : {false, true}) {
      for (const double ratio : {1.2, 2.0, 2.7}) {
        ReferenceSettings s = tank(kTankSpacing, kTankSpacing * glm::dvec3(5, 4, 1));
        s.gravity = glm::dvec3(0);
        s.kernel = kernel;
        s.smoothingRatio = ratio;
        s.tabulated = tabulated;
        s.relaxation = 0.3;
        const std::vector<glm::dvec3> x = lattice(5, 4, 1, kTankSpacing);
        ReferenceSolver solver(s, x);
        run(solver, 2e-3, 30);
        for (size_t i = 0; i < x.size(); ++i)
          EXPECT_LT(glm::length(solver.state.position[i] - x[i]), (tabulated ? 1e-4 : 1e-9) * kTankSpacing);
      }
    }
  }
}

TEST(ReferenceSolver, DropFallsFreely) {
  ReferenceSettings s;
  s.spacing = kTankSpacing;
  const std::vector<glm::dvec3> x = lattice(5, 5, 5, kTankSpacing);
  ReferenceSolver solver(s, x);
  const double dt = 2e-3;
  const int steps = 200;
  run(solver, dt, steps);
  for (size_t i = 0; i < x.size(); ++i) {
    const glm::dvec3 exact = x[i] + 0.5 * s.gravity * dt * dt * double(steps * (steps + 1));
    EXPECT_LT(glm::length(solver.state.position[i] - exact), 1e-9);
    EXPECT_LT(glm::length(solver.state.velocity[i] - s.gravity * dt * double(steps)), 1e-7);
  }
}

TEST(ReferenceSolver, ReportsStagesInOrder) {
  ReferenceSettings s;
  s.spacing = kTankSpacing;
  s.iterations = 2;
  s.viscosity = s.drag = s.vorticity = s.surfaceTension = 0.1;
  s.motionSpeed = 1;
  s.viscosityAtRest = 1;
  s.tensile = 1;
  ReferenceSolver solver(s, lattice(3, 3, 3, 0.8 * kTankSpacing));
  std::vector<Stage> stages;
  solver.onStage = [&](Stage stage) { stages.push_back(stage); };
  solver.begin(1e-3);
  EXPECT_TRUE(stages.empty());
  solver.substep(1e-3, 1e-3);
  EXPECT_EQ(stages, (std::vector<Stage>{Stage::Density, Stage::Multipliers, Stage::Correction, Stage::Density, Stage::Multipliers,
                                        Stage::Correction, Stage::Velocities, Stage::Viscosity, Stage::NoiseDamping, Stage::Vorticity,
                                        Stage::Drag, Stage::SurfaceTension, Stage::Prediction}));
  EXPECT_GT(solver.artificialPressurePush(), 0) << "the last correction has artificial pressure";
}

TEST(ReferenceSolver, ColumnStaysAtRest) {
  const int layers = 8;
  ReferenceSettings s = tank(kTankSpacing, kTankSpacing * glm::dvec3(6, 3 * layers, 6));
  s.relaxation = 0.5;
  s.warmStart = 0.01;
  ReferenceSolver solver(s, lattice(6, layers, 6, kTankSpacing));
  const double height = centerOfMass(solver).y;
  run(solver, 1.0 / 960, 960);
  EXPECT_LT(rmsSpeed(solver), 0.05);
  EXPECT_NEAR(centerOfMass(solver).y / height, 1, 0.01);
  EXPECT_LT(compression(solver), 0.002);
  EXPECT_EQ(solver.inactive(), 0u);
}

// Largest acceleration, over g, of a column under its initial pressure. It must be as small at walls and edges, where the tangential
// scale compensates for missing neighbors, as in the middle. See docs/notes/initial-pressure.md.
double maxAccelerationOfPressurizedColumn(ReferenceSettings s, int layers) {
  s.relaxation = 0.4;
  ReferenceSolver solver(s, lattice(6, layers, 6, kTankSpacing));
  const double dt = 1e-3, g = 9.81;
  solver.solveInitialPressure(dt, 0.8, 400);
  solver.begin(dt);
  double largest = 0;
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 &from = solver.state.position[i], &to = solver.state.predicted[i];
    if (from.y > 4 * kTankSpacing && from.y < (layers - 4) * kTankSpacing)
      largest = std::max(largest, std::abs(to.y - from.y) / (dt * dt * g));
  }
  return largest;
}

TEST(ReferenceSolver, InitialPressureSupportsColumnAtWalls) {
  const int layers = 16;
  for (const bool tabulated : {false, true}) {
    for (const double ratio : {2.0, 2.5}) {
      ReferenceSettings s = tank(kTankSpacing, kTankSpacing * glm::dvec3(6, 2 * layers, 6));
      s.smoothingRatio = ratio;
      s.tabulated = tabulated;
      EXPECT_LT(maxAccelerationOfPressurizedColumn(s, layers), 0.045) << "of g, h = " << ratio << " d" << (tabulated ? ", tabulated" : "");
    }
  }
}

TEST(ReferenceSolver, DamBreakStaysInsideAndGainsNoEnergy) {
  for (const bool tabulated : {true, false}) {
    ReferenceSettings s = tank(kTankSpacing, kTankSpacing * glm::dvec3(24, 24, 6));
    s.tabulated = tabulated;
    s.relaxation = 0.7;
    s.warmStart = 0.1;
    ReferenceSolver solver(s, lattice(9, 12, 6, kTankSpacing));
    const double start = energy(solver), dt = 1.0 / 960;
    solver.begin(dt);
    double highest = 0, error = 0;
    const int steps = tabulated ? 960 : 120;
    for (int step = 0; step < steps; ++step) {
      solver.substep(dt, dt);
      highest = std::max(highest, energy(solver));
      error += compression(solver) / steps;
      for (const glm::dvec3& x : solver.state.position) {
        for (int a = 0; a < 3; ++a) {
          ASSERT_GE(x[a], s.lo[a] + 0.5 * kTankSpacing);
          ASSERT_LE(x[a], s.hi[a] - 0.5 * kTankSpacing);
        }
      }
    }
    EXPECT_LT(highest / start, 1.002);
    EXPECT_LT(error, 0.002);
    EXPECT_EQ(solver.inactive(), 0u);
    if (tabulated) { EXPECT_GT(centerOfMass(solver).x, 1.4 * 4.5 * kTankSpacing); }
  }
}

TEST(ReferenceSolver, CoincidentParticlesSeparate) {
  ReferenceSettings s;
  s.spacing = kTankSpacing;
  s.gravity = glm::dvec3(0);
  ReferenceSolver lone(s, std::vector<glm::dvec3>(2, glm::dvec3(0.1)));
  run(lone, 1e-3, 20);
  EXPECT_GT(leastDistance(lone), 1.9e-3 * lone.kernel().h());
  EXPECT_LT(glm::length(meanVelocity(lone)), 1e-15);

  ReferenceSolver pile(s, std::vector<glm::dvec3>(30, glm::dvec3(-0.2)));
  run(pile, 1e-3, 20);
  EXPECT_GT(leastDistance(pile), 1e-3 * pile.kernel().h());
  EXPECT_EQ(pile.inactive(), 0u);
}

TEST(ReferenceSolver, DeactivatesNonFiniteParticles) {
  ReferenceSettings s = tank(kTankSpacing, kTankSpacing * glm::dvec3(6, 12, 6));
  std::vector<glm::dvec3> x = lattice(6, 6, 6, kTankSpacing), v(x.size(), glm::dvec3(0));
  x[3].y = kNaN;
  v[100].z = std::numeric_limits<double>::infinity();
  ReferenceSolver solver(s, x, v);
  run(solver, 1e-3, 5);
  EXPECT_EQ(solver.inactive(), 2u);
  solver.state.velocity[50].x = kNaN;
  solver.density();
  solver.predict(1e-3, 1e-3);
  EXPECT_EQ(solver.inactive(), 3u);
  EXPECT_EQ(solver.state.velocity[50], glm::dvec3(0));
  for (int step = 0; step < 50; ++step) solver.substep(1e-3, 1e-3);
  for (const glm::dvec3& p : solver.state.position)
    for (int a = 0; a < 3; ++a) EXPECT_TRUE(p[a] >= 0 && p[a] <= s.hi[a]);
  EXPECT_LT(rmsSpeed(solver), 3);
}

TEST(ReferenceSolver, HandlesZeroParticles) {
  ReferenceSolver solver(tank(kTankSpacing, glm::dvec3(1)), {});
  run(solver, 1e-3, 3);
  EXPECT_EQ(solver.size(), 0u);
}

TEST(ReferenceSolver, LimitsSpeed) {
  ReferenceSettings s;
  s.spacing = kTankSpacing;
  s.speedLimit = 4;
  ReferenceSolver solver(s, randomCloud(200, 2 * kTankSpacing, 4));
  run(solver, 1e-3, 3);
  for (const glm::dvec3& v : solver.state.velocity) EXPECT_LE(glm::length(v), 4 * (1 + 1e-12));
}

TEST(ReferenceSolver, IsTranslationInvariantWithVaryingSteps) {
  ReferenceSettings s = tank(kTankSpacing, kTankSpacing * glm::dvec3(12, 12, 4));
  ReferenceSettings far = s;
  const glm::dvec3 away = {1000, -500, 250};
  far.lo += away;
  far.hi += away;
  std::vector<glm::dvec3> x = lattice(5, 6, 4, kTankSpacing);
  ReferenceSolver here(s, x);
  for (glm::dvec3& p : x) p += away;
  ReferenceSolver there(far, x);
  const double steps[] = {1e-3, 0.5e-3, 2e-3};
  here.begin(steps[0]);
  there.begin(steps[0]);
  for (int n = 0; n < 60; ++n) {
    here.substep(steps[n % 3], steps[(n + 1) % 3]);
    there.substep(steps[n % 3], steps[(n + 1) % 3]);
  }
  for (size_t i = 0; i < here.size(); ++i) EXPECT_LT(glm::length(there.state.position[i] - away - here.state.position[i]), 1e-7);
}

TEST(ReferenceSolver, VorticityConfinementStaysStable) {
  double kinetic[2];
  for (const bool on : {false, true}) {
    ReferenceSettings s = tank(kTankSpacing, kTankSpacing * glm::dvec3(24, 24, 4));
    s.vorticity = on ? 1 : 0;
    ReferenceSolver solver(s, lattice(9, 12, 4, kTankSpacing));
    const double start = energy(solver), dt = 1.0 / 960;
    solver.begin(dt);
    double highest = 0;
    for (int step = 0; step < 960; ++step) {
      solver.substep(dt, dt);
      highest = std::max(highest, energy(solver));
    }
    EXPECT_LT(highest / start, on ? 1.05 : 1.002);
    kinetic[on] = rmsSpeed(solver);
  }
  EXPECT_NE(kinetic[0], kinetic[1]);
}

}  // namespace
}  // namespace rill::reference
