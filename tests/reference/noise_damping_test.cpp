// What noise damping of the reference solver takes: of noise, of waves and of flows.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/cloud.hpp"

namespace rill::reference {
namespace {

constexpr double kDampedSpacing = 0.05;

/// What noise damping takes of the shear wave v_x = cos(2 pi y / (n d)) in the middle of a lattice, over its theory: c (k^2 M / 2)^2, M the
/// kernel's second moment, which follows from the decay by the viscosity that is c's: c k^2 M / 2 = nu k^2 dt. `stream`: v_z, in units of
/// the speed that noise damping spares by half, which is a thousand times the wave's.
double noiseDampingOverTheory(int wavelength, double viscosity = 10, double stream = 0) {
  constexpr int kWide = 11, kMiddle = kWide * kWide * kWide / 2;
  const double dt = 1e-3, k = 2 * std::numbers::pi / (wavelength * kDampedSpacing);
  ReferenceSettings s;
  s.spacing = kDampedSpacing;
  s.gravity = glm::dvec3(0);
  s.motionSpeed = 1e6;
  s.viscosityAtRest = viscosity;
  s.sparedFlow = 1e3;
  ReferenceSolver solver(s, lattice(kWide, kWide, kWide, kDampedSpacing));
  const double middle = solver.state.position[kMiddle].y, c = 2 * s.viscosityAtRest * dt / (s.density * solver.kernel().secondMoment());
  double kept = 1;
  solver.onStage = [&](Stage stage) {
    if (stage == Stage::Velocities)
      for (size_t i = 0; i < solver.size(); ++i)
        solver.state.velocity[i] = {std::cos(k * (solver.state.position[i].y - middle)), 0, stream * s.sparedFlow};
    if (stage == Stage::NoiseDamping) kept = solver.state.velocity[kMiddle].x;
  };
  solver.begin(dt);
  solver.substep(dt, dt);
  const double once = s.viscosityAtRest / s.density * k * k * dt;
  return (1 - kept) / (once * once / c);
}

TEST(NoiseDamping, IsBounded) {
  // Theory without the bound takes in proportion to the viscosity.
  EXPECT_NEAR(noiseDampingOverTheory(48, 1e7) * 10 / noiseDampingOverTheory(48, 1e6), 1, 1e-9);
}

TEST(NoiseDamping, TakesFourthPowerOfWaveNumber) {
  EXPECT_NEAR(noiseDampingOverTheory(48), 1, 0.02);
  EXPECT_NEAR(noiseDampingOverTheory(24), 1, 0.05);
  EXPECT_LT(noiseDampingOverTheory(4), 0.8) << "waves as short as the support lose less than the theory of long ones";
}

TEST(NoiseDamping, SparesFlows) {
  const double still = noiseDampingOverTheory(24);
  EXPECT_NEAR(noiseDampingOverTheory(24, 10, 0.1) / still, 1, 1e-3);
  EXPECT_NEAR(noiseDampingOverTheory(24, 10, 1) / still, 0.5, 1e-3);
  EXPECT_NEAR(noiseDampingOverTheory(24, 10, 3) / still, 1 / 82.0, 1e-3);
}

}  // namespace
}  // namespace rill::reference
