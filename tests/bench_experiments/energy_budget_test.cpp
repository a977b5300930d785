#include "bench/experiments/energy_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace rill::bench {
namespace {

WaveTank smallTank() {
  WaveTank tank{.spacing_m = 0.1, .thickness = 4, .periods = 0.3};
  tank.wave = {.length_m = 1, .depth_m = 0.6, .amplitude_m = 0.04};
  return tank;
}

EnergyBudget budgetOf(std::string_view changes, const WaveTank& tank = smallTank()) {
  const auto settings = waveSettings(changes);
  if (!settings) throw std::runtime_error(settings.error().message);
  const auto budget = energyBudget(tank, *settings, 1.0 / 240, [] { return false; });
  if (!budget) throw std::runtime_error(budget.error().message);
  return *budget;
}

TEST(EnergyBudget, WorkOfAllTermsExplainsTheChange) {
  for (const char* changes : {"", "fluid.viscosity=20", "solver.iterations=3 solver.tolerance=0", "fluid.tensile=1"}) {
    const EnergyBudget budget = budgetOf(changes);
    EXPECT_NEAR(budget.imbalance(), 0, 1e-9) << changes;
    EXPECT_LT(budget.unexplained, 1e-9) << changes;  // away from walls, the other terms explain all
    EXPECT_GT(std::abs(budget.at(Term::Pressure)), 1e-4) << changes;
    EXPECT_LT(budget.wave, 1.1) << changes;
    EXPECT_GT(budget.wave, 0.2) << changes;
  }
}

TEST(EnergyBudget, AbsentTermsDoNoWork) {
  const EnergyBudget budget = budgetOf("solver.artificial_viscosity=0 fluid.tensile=0");
  EXPECT_EQ(budget.at(Term::Viscosity), 0);
  EXPECT_EQ(budget.at(Term::NoiseDamping), 0);
  EXPECT_EQ(budget.at(Term::ArtificialPressure), 0);
}

TEST(EnergyBudget, ViscosityTakesEnergy) {
  EXPECT_LT(budgetOf("fluid.viscosity=20").at(Term::Viscosity), -0.01);
  EXPECT_LT(budgetOf("").at(Term::NoiseDamping), 0);
}

TEST(EnergyBudget, StartsWithTheWholeEnergyInTheWave) {
  WaveTank tank = smallTank();
  tank.periods = 0;
  const EnergyBudget budget = budgetOf("", tank);
  EXPECT_NEAR(budget.wave, 1, 1e-12);
  EXPECT_NEAR(budget.noise, 0, 1e-12);
  EXPECT_NEAR(budget.otherPotential, 0, 1e-12);
}

}  // namespace
}  // namespace rill::bench
