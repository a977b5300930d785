#include "bench/experiments/energy_budget.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "bench/experiments/wave_starts.hpp"
#include "reference/scene_settings.hpp"

namespace rill::bench {
namespace {

using reference::ReferenceSolver;
using reference::Stage;
using Vectors = std::vector<glm::dvec3>;

constexpr double kSwing = 0.3;  // of the amplitude: a crossing before it is noise of the start

/// Adds up the work of terms while a solver runs. The velocity changes of the terms add up to v1 - v0, and each does the work
/// m (v0 + v1) / 2 . change, so that nothing is left over.
class WorkMeter {
 public:
  explicit WorkMeter(ReferenceSolver& solver) : solver_(solver), pressure_(solver.size()), artificial_(solver.size()) {}

  /// After begin(), and after each substep's prediction: `dt` of the substep to come.
  void beginSubstep(double dt) {
    dt_ = dt;
    before_ = solver_.state.velocity;
    for (size_t i = 0; i < solver_.size(); ++i) {
      artificial_[i] = glm::dvec3(0);
      pressure_[i] = solver_.state.warm[i] / dt_ * solver_.ownGradient(i);
      for (const auto& pair : solver_.pairs(i)) pressure_[i] += (solver_.state.warm[i] + solver_.state.warm[pair.j]) / dt_ * pair.gradient;
    }
  }

  void after(Stage stage) {
    if (stage == Stage::Correction) addCorrection();
    if (stage == Stage::Velocities) addMotion();
    if (stage == Stage::Viscosity) addVelocityChange(Term::Viscosity);
    if (stage == Stage::NoiseDamping) addVelocityChange(Term::NoiseDamping);
  }

  double work(Term term) const { return work_[static_cast<size_t>(term)]; }  // J
  double unexplained() const { return unexplained_; }

 private:
  void addCorrection() {
    const auto change = solver_.lambdaChange();
    for (size_t i = 0; i < solver_.size(); ++i) {
      pressure_[i] += change[i] / dt_ * solver_.ownGradient(i);
      for (const auto& pair : solver_.pairs(i)) {
        pressure_[i] += (change[i] + change[pair.j]) / dt_ * pair.gradient;
        artificial_[i] += solver_.artificialPressureTerm(pair.value, solver_.artificialPressurePush()) / dt_ * pair.gradient;
      }
    }
  }

  // The rest is of walls; limits of speed are not reached in waves.
  void addMotion() {
    const glm::dvec3 gravity = dt_ * solver_.settings.gravity;
    for (size_t i = 0; i < solver_.size(); ++i) {
      const glm::dvec3 all = solver_.state.velocity[i] - before_[i];
      add(Term::Gravity, i, gravity);
      work_[static_cast<size_t>(Term::Gravity)] -= solver_.mass() * glm::dot(gravity, solver_.state.velocity[i]);
      add(Term::Pressure, i, pressure_[i]);
      add(Term::ArtificialPressure, i, artificial_[i]);
      const glm::dvec3 rest = all - gravity - pressure_[i] - artificial_[i];
      add(Term::Walls, i, rest);
      if (isFarFromWalls(solver_.state.position[i])) unexplained_ = std::max(unexplained_, glm::length(rest));
    }
    before_ = solver_.state.velocity;
  }

  void addVelocityChange(Term term) {
    for (size_t i = 0; i < solver_.size(); ++i) add(term, i, solver_.state.velocity[i] - before_[i]);
    before_ = solver_.state.velocity;
  }

  bool isFarFromWalls(const glm::dvec3& x) const {
    const glm::dvec3 gap = glm::min(x - solver_.settings.lo, solver_.settings.hi - x);
    return std::min({gap.x, gap.y, gap.z}) > 1.5 * solver_.settings.spacing;
  }

  void add(Term term, size_t i, const glm::dvec3& change) {
    work_[static_cast<size_t>(term)] += 0.5 * solver_.mass() * glm::dot(before_[i] + solver_.state.velocity[i], change);
  }

  ReferenceSolver& solver_;
  double dt_ = 0;
  Vectors before_, pressure_, artificial_;  // velocity changes, m/s
  std::array<double, kTerms> work_{};       // J
  double unexplained_ = 0;                  // m/s
};

struct Energy {
  double kinetic = 0, potential = 0, waveKinetic = 0, wavePotential = 0;  // J
};

/// Amplitude of the wave in the surface, m.
double surfaceOf(const ReferenceSolver& solver, const StandingWave& wave) {
  Cloud cloud;
  for (const glm::dvec3& x : solver.state.position) cloud.position.push_back({x.x, x.y, x.z});
  return modalAmplitude(cloud, wave.waveNumber(), wave.depth_m);
}

Energy energyOf(const ReferenceSolver& solver, const WaveTank& tank) {
  const double area = tank.wave.length_m * tank.thickness * tank.spacing_m;
  double along = 0, square = 0;
  Energy energy;
  for (size_t i = 0; i < solver.size(); ++i) {
    const glm::dvec3 &x = solver.state.position[i], &v = solver.state.velocity[i], shape = reference::vec(tank.wave.shape(x.x, x.y));
    along += glm::dot(v, shape);
    square += glm::dot(shape, shape);
    energy.kinetic += 0.5 * solver.mass() * glm::dot(v, v);
    energy.potential -= solver.mass() * glm::dot(solver.settings.gravity, x);
  }
  energy.waveKinetic = 0.5 * solver.mass() * along * along / square;
  const double amplitude = surfaceOf(solver, tank.wave);
  energy.wavePotential = 0.25 * solver.settings.density * tank.wave.gravity * area * amplitude * amplitude;
  return energy;
}

constexpr int kBudgetThickness = 4;     // layers: the solver runs on one core
constexpr double kBudgetRate = 444;     // substeps a second: about those of the device
constexpr double kBudgetPeriods = 1.3;  // of theory, at most
constexpr WaveSetting kBudgetSettings[] = {
    {"energy", ""}, {"energy-undamped", "solver.artificial_viscosity=0"}, {"energy-2", "fluid.smoothing_ratio=2"}};

Expected<Outcome> runBudget(const Bench& bench, const char* changes) {
  WaveTank tank = deepTank(1, 0);
  tank.thickness = kBudgetThickness;
  tank.periods = kBudgetPeriods;
  const auto settings = waveSettings(changes);
  if (!settings) return settings.error();
  const auto began = std::chrono::steady_clock::now();
  const auto budget = energyBudget(tank, *settings, 1 / kBudgetRate, [&] { return bench.stopped(); });
  if (!budget) return budget.error();
  Outcome outcome;
  outcome.run.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  outcome.run.simulated_s = budget->time_s;
  outcome.run.particles = budget->particles;
  outcome.figures = {plainFigure("imbalance", budget->imbalance()), plainFigure("unexplained", budget->unexplained),
                     plainFigure("energy lost", 1 - budget->wave)};
  outcome.curves["energy"] = {{"wave", budget->wave}, {"noise", budget->noise}, {"other_potential", budget->otherPotential}};
  for (size_t k = 0; k < kTerms; ++k) outcome.curves["work"][kTermNames[k]] = budget->work[k];
  return outcome;
}

}  // namespace

std::vector<Experiment> energyBudgetExperiments() {
  std::vector<Experiment> all;
  for (const WaveSetting& setting : kBudgetSettings)
    all.push_back({setting.name, 0, false, deepTank(1, 0).spacing_m,
                   [changes = setting.changes](const Bench& bench) { return runBudget(bench, changes); }});
  return all;
}

double EnergyBudget::imbalance() const { return wave + noise + otherPotential - 1 - std::accumulate(work.begin(), work.end(), 0.0); }

Expected<EnergyBudget> energyBudget(const WaveTank& tank, const Scene& settings, double step_s, const std::function<bool()>& stopped) {
  const StandingWave& wave = tank.wave;
  Scene scene = waveScene(tank, settings);
  scene.solver.time_step = step_s;
  const Cloud cloud = standingWave(wave, tank.spacing_m, tank.thickness);
  Vectors lattice, velocity;
  for (size_t i = 0; i < cloud.size(); ++i) {
    lattice.push_back(reference::vec(cloud.position[i]));
    velocity.push_back(reference::vec(cloud.velocity[i]));
  }
  double fastest = 0;
  for (const glm::dvec3& v : velocity) fastest = std::max(fastest, glm::length(v));
  const auto setup = makeFluidSetup(scene, {.capacity = static_cast<uint32_t>(lattice.size()),
                                            .extent = {wave.length_m, wave.depth_m, tank.thickness * tank.spacing_m},
                                            .fastest = fastest});
  if (!setup) return setup.error();

  ReferenceSolver solver(reference::settingsOf(scene, *setup, {0, 0, 0}), lattice, velocity);
  const FluidParams& params = setup->params;
  if (params.initialPressureIterations > 0)
    solver.solveInitialPressure(params.initialPressureStep, params.initialPressureMomentum,
                                static_cast<int>(params.initialPressureIterations));
  solver.begin(step_s);
  WorkMeter meter(solver);
  meter.beginSubstep(step_s);
  solver.onStage = [&](Stage stage) {
    meter.after(stage);
    if (stage == Stage::Prediction) meter.beginSubstep(step_s);
  };
  const Energy start = energyOf(solver, tank);
  double highest = 0, before = 0;
  for (int crossings = 0; crossings < 2 && solver.time() < tank.periods * wave.period() && !stopped();) {
    solver.substep(step_s, step_s);
    const double now = surfaceOf(solver, wave);
    highest = std::max(highest, std::abs(now));
    if (highest > kSwing * wave.amplitude_m && (now < 0) != (before < 0)) ++crossings;
    before = now;
  }

  const Energy end = energyOf(solver, tank);
  EnergyBudget budget;
  budget.particles = solver.size();
  budget.time_s = solver.time();
  budget.unexplained = meter.unexplained();
  budget.wave = (end.waveKinetic + end.wavePotential) / start.kinetic;
  budget.noise = (end.kinetic - end.waveKinetic) / start.kinetic;
  budget.otherPotential = (end.potential - start.potential - end.wavePotential) / start.kinetic;
  for (size_t k = 0; k < kTerms; ++k) budget.work[k] = meter.work(static_cast<Term>(k)) / start.kinetic;
  return budget;
}

}  // namespace rill::bench
