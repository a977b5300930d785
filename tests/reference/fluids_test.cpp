// Several fluids in the reference solver: momenta, and equal fluids are one.
#include <gtest/gtest.h>

#include "reference/cloud.hpp"

namespace rill::reference {
namespace {

/// A cloud at about twice the rest density, of fluids that alternate.
ReferenceSolver mixed(const std::vector<ReferenceFluid>& fluids) {
  constexpr double kMixedSpacing = 0.05;
  ReferenceSettings s;
  s.spacing = kMixedSpacing;
  s.gravity = glm::dvec3(0);
  s.tensile = 1;
  s.viscosityAtRest = 0.5;
  s.motionSpeed = 1e9;  // at rest, so that noise is damped
  s.relaxationAtRest = 0.5;
  s.fluids = fluids;
  for (const ReferenceFluid& fluid : fluids) s.viscosity = std::max(s.viscosity, fluid.viscosity);
  ReferenceSolver solver(s, randomCloud(300, 5.3 * kMixedSpacing, 5), randomCloud(300, 2, 6, glm::dvec3(-1)));
  for (size_t i = 0; i < solver.size(); ++i) solver.state.fluid[i] = static_cast<uint8_t>(i % std::max<size_t>(fluids.size(), 1));
  return solver;
}

TEST(Fluids, ConserveMomentaOfDifferentMasses) {
  for (const double lighter : {300.0, 1.0}) {
    ReferenceSolver solver = mixed({{1000, 1}, {lighter, 0.1}});
    const auto momenta = [&] {
      std::pair<glm::dvec3, glm::dvec3> sum(0, 0);
      for (size_t i = 0; i < solver.size(); ++i) {
        const glm::dvec3 momentum = solver.state.velocity[i] / solver.inverseMass(i);
        sum.first += momentum;
        sum.second += glm::cross(solver.state.position[i], momentum);
      }
      return sum;
    };
    const double size = rmsSpeed(solver) * static_cast<double>(solver.size());
    solver.begin(1e-4);
    const auto before = momenta();
    for (int step = 0; step < 5; ++step) solver.substep(1e-4, 1e-4);
    EXPECT_LT(glm::length(momenta().first - before.first), 1e-10 * size) << lighter;
    solver.state.predicted = solver.state.position;
    solver.density();  // the pairs at the positions
    const auto after = momenta();
    solver.viscosity(0.01);
    EXPECT_LT(glm::length(momenta().second - after.second), 1e-10 * size) << lighter;
  }
}

TEST(Fluids, OfEqualMaterialsMoveAsOne) {
  ReferenceSolver one = mixed({}), two = mixed({{1000, 0}, {1000, 0}});
  one.settings.viscosityAtRest = two.settings.viscosityAtRest = 0;  // damps each fluid alone
  for (ReferenceSolver* solver : {&one, &two}) {
    solver->begin(1e-3);
    for (int step = 0; step < 5; ++step) solver->substep(1e-3, 1e-3);
  }
  for (size_t i = 0; i < one.size(); ++i) EXPECT_LT(glm::length(one.state.position[i] - two.state.position[i]), 1e-12) << i;
}

TEST(Fluids, LighterParticlesGiveWay) {
  ReferenceSettings s;
  s.spacing = 0.05;
  s.gravity = glm::dvec3(0);
  s.tensile = 0;
  s.fluids = {{1000, 0}, {10, 0}};
  const std::vector<glm::dvec3> x = randomCloud(60, 0.12, 3);
  ReferenceSolver solver(s, x);
  for (size_t i = 0; i < x.size(); ++i) solver.state.fluid[i] = i % 2;
  solver.density();
  solver.multipliers(true);
  const std::vector<glm::dvec3> before = solver.state.predicted;
  solver.correction(1e-3, 0);
  double heavy = 0, light = 0;
  for (size_t i = 0; i < x.size(); ++i) (i % 2 == 0 ? heavy : light) += glm::length(solver.state.predicted[i] - before[i]);
  EXPECT_GT(light, 20 * heavy) << "a hundred times as mobile";
}

}  // namespace
}  // namespace rill::reference
