#pragma once
// Where the energy of a standing wave goes: work of each term of a substep, from the reference solver.
#include <array>
#include <functional>

#include "bench/experiments/waves.hpp"

namespace rill::bench {

/// Terms of a substep that do work. Gravity: its work minus the change of potential energy, the error of the finite step. Walls: what stops
/// particles at them, which is all that the other terms do not explain.
enum class Term { Gravity, Pressure, ArtificialPressure, Walls, Viscosity, NoiseDamping };
constexpr size_t kTerms = 6;
constexpr const char* kTermNames[kTerms] = {"gravity", "pressure", "artificial pressure", "walls", "viscosity", "noise damping"};

/// Energies and work in units of the wave's energy at the start.
struct EnergyBudget {
  size_t particles = 0;
  double time_s = 0;                  ///< at the end
  double wave = 0;                    ///< of the particles' velocities and of the surface, both projected on the wave
  double noise = 0;                   ///< other kinetic energy
  double otherPotential = 0;          ///< change of the potential energy but for the wave's: fluid that takes more or less room
  std::array<double, kTerms> work{};  ///< by term; wave + noise + otherPotential = 1 + sum of the work
  double unexplained = 0;             ///< largest velocity change by walls more than a spacing away from them, m/s: rounding

  double at(Term term) const { return work[static_cast<size_t>(term)]; }
  double imbalance() const;  ///< what rounding leaves of that equation
};

/// Runs the reference solver from the rest lattice with the speeds of the wave at zero elevation until the wave has zero elevation for the
/// second time: a period, whatever its length, after which the lattice's resistance to shear holds no energy. At most tank.periods of
/// theory. `stopped`: asked once a substep; the budget is then that of the time so far. `settings` as in releaseWave(), without vorticity
/// and drag, whose work is not measured.
Expected<EnergyBudget> energyBudget(const WaveTank& tank, const Scene& settings, double step_s, const std::function<bool()>& stopped);

/// A slosh, mode 1, for a few settings. The report has the budget in curves["energy"] and curves["work"].
std::vector<Experiment> energyBudgetExperiments();

}  // namespace rill::bench
