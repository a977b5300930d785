#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace rill::bench {

/// What a stress case ended with.
struct StressOutcome {
  RunFigures run;
  offline::Particles particles;  ///< of the last instant, by id
};

/// A scene that is hard on the solver. Of every case it is asserted that all is finite, no particle is lost, none is outside the walls,
/// speeds are bounded, energy never rises above the start's by 2 %, and the validation layer is silent; `own` asserts what is special.
struct StressCase {
  std::string name;
  std::string asserts;  ///< in words, what `own` does
  Scene scene;
  std::optional<ParticleSet> start;  ///< in place of the scene's fills
  double duration_s = 0.5;
  double frame_s = 1.0 / 60;
  uint64_t parked = 0;        ///< particles that are not numbers at the start
  double maxSpeed = 0;        ///< m/s
  bool worked = false;        ///< solids or a changing gravity do work on it: energy is not held against the start's
  double maxEnergy = 1.02;    ///< over the start's
  bool mayRefuse = false;     ///< a clear refusal will do
  std::optional<Scene> like;  ///< a scene for 0.5 s, of which this is the same at another size or place: errors and energy agree
  bool twice = false;         ///< run again: the same bits, and no drift of the energy
  bool full = false;          ///< too long for a quick run
  std::function<std::string(const StressOutcome&)> own;  ///< empty: it holds; else what was found and what was expected
};

/// A box of fluid of `spacing` in a tank, both from the origin, m.
Scene tankScene(double spacing, const Point& fluid, const Point& tank);
/// Particles at these places, at rest or moving.
ParticleSet placed(std::vector<Float3> positions, const Float3& velocity = {});
/// A bound of speeds that any real flow of the scene keeps: a few times what falling through all the room gives, and what it starts with.
double usualSpeed(const Scene& scene, double start = 0);

std::vector<StressCase> startCases();                                 ///< odd starts
std::vector<StressCase> forceCases();                                 ///< odd forces, steps, scales
std::vector<StressCase> sizeCases();                                  ///< counts at their edges
std::vector<StressCase> parameterCases();                             ///< each key of fluid and solver at its smallest and largest value
std::vector<StressCase> randomCases(uint64_t first, uint64_t count);  ///< "random-7" is the same on every run

}  // namespace rill::bench
