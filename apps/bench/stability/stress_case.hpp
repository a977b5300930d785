#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace rill::bench {

/// Result of a stress case.
struct StressOutcome {
  RunFigures run;
  offline::Particles particles;  ///< final state, by id
};

/// A scene that stresses the solver. Every case checks: all values finite, no particle lost or outside the walls, speed bounded, energy at
/// most 1.02 of the initial energy, no validation messages. `check` adds case-specific checks.
struct StressCase {
  std::string name;
  std::string asserts;  ///< describes what `check` checks
  Scene scene;
  std::optional<ParticleSet> start;  ///< replaces the scene's fills
  double duration_s = 0.5;
  double frame_s = 1.0 / 60;
  uint64_t inactive = 0;           ///< expected number of particles with a non-finite start
  double maxSpeed = 0;             ///< m/s
  bool externalWork = false;       ///< solids or changing gravity do work: the energy is not checked
  double maxEnergy = 1.02;         ///< largest energy / initial energy
  bool mayBeRejected = false;      ///< BadInput and TooLarge are valid results
  std::optional<Scene> reference;  ///< the same scene at its usual size and place, run for 0.5 s: errors and energy must agree
  bool checksRepeat = false;       ///< a second run gives the same bits, and the energy does not drift
  bool fullOnly = false;           ///< excluded from --quick: long, or much like another case
  std::function<std::string(const StressOutcome&)> check;  ///< empty string: passed; else the value found and expected
};

inline constexpr double kTankSpacing = 0.05;  ///< m

/// A box of fluid in a tank; both start at the origin, sizes in m.
Scene tankScene(double spacing, const Double3& fluid, const Double3& tank);
/// Particles at `positions` with a common velocity.
ParticleSet particlesAt(std::vector<Float3> positions, const Float3& velocity = {});
/// A bound on physical speeds of the scene: a multiple of the speed from falling through the domain plus the initial speed.
double speedBound(const Scene& scene, double start = 0);

std::vector<StressCase> startCases();  ///< degenerate initial states
std::vector<StressCase> forceCases();  ///< extreme forces, time steps and scales
std::vector<StressCase> bodyCases();   ///< rigid bodies
std::vector<StressCase> flowCases();   ///< emitters and drains
/// Up to three emitters and two drains in the domain of a scene.
void addRandomFlows(Scene& scene, uint64_t seed);
/// Two to eight fluids of densities up to 1:1000 and any viscosity, side by side in the scene's fill, a box; emitters get one of them.
void addRandomFluids(Scene& scene, uint64_t seed);
std::vector<StressCase> sizeCases();                                  ///< numbers of particles at internal limits
std::vector<StressCase> parameterCases();                             ///< each key of fluid and solver at its minimum and maximum
std::vector<StressCase> randomCases(uint64_t first, uint64_t count);  ///< reproducible: the name is the seed

}  // namespace rill::bench
