#include "reference/solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "shared/fluid_records.h"
#include "sph/background_pressure.hpp"
#include "sph/liquid_scale.hpp"

namespace rill::reference {

ReferenceSolver::ReferenceSolver(const ReferenceSettings& s, std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities)
    : settings(s),
      kernel_(s.kernel, s.smoothingRatio * s.spacing, s.spacing),
      liquidScale_(liquidScale(kernel_)),
      artificial_(kernel_, s.tensile, s.tensileRadius, s.tensilePower),
      walls_({s.lo, s.hi, s.spacing / 2}),
      time_(s.startTime),
      bodies_(settings.solids, settings.origin, walls_, s.spacing, s.separationSpeed) {
  assert(velocities.empty() || velocities.size() == positions.size());
  const size_t count = positions.size();
  state.position.assign(positions.begin(), positions.end());
  state.velocity.assign(velocities.begin(), velocities.end());
  state.velocity.resize(count, glm::dvec3(0));
  state.predicted = state.position;
  state.warm.assign(count, 0);
  state.id.resize(count);
  std::iota(state.id.begin(), state.id.end(), 0u);
  state.fluid.assign(count, 0);
  lambda_.assign(count, 0);
  lambdaChange_.assign(count, 0);
  lastChange_.assign(count, 0);
  predictionPush_ = pushedOut_ = std::vector<double>(count, 0);
  delta_.assign(count, 0);
  curl_.assign(count, glm::dvec3(0));
  rejected_.assign(count, glm::dvec3(0));
  rejectedBefore_ = rejected_;
  gaveWay_.assign(count, false);
  backgroundShare_.assign(count, 0);
  coherence_.assign(count, 0);
  planned_ = gain_ = wallPosition_ = std::vector<glm::dvec3>(count, glm::dvec3(0));
  for (const glm::dvec3& v : state.velocity)
    if (finite(v)) addSpeed(glm::length(v));
  walls_.outflowAxis = settings.outflowAxis;
  walls_.outflowHigh = settings.outflowHigh;
  walls_.outflowLevel = settings.outflowLevel;
  for (int a = 0; a < 3; ++a) walls_.margin = std::min(walls_.margin, (settings.hi[a] - settings.lo[a]) / 2);
  if (!settings.solids.empty() || !settings.emitters.empty()) {
    halfSpace_ = makeHalfSpaceTable(kernel_);
    noSlipTable_ = makeNoSlipTable(kernel_);
  }
  for (const Solid& solid : settings.solids) {
    const auto* sphere = std::get_if<SphereShape>(&solid.shape);
    const auto* mesh = std::get_if<MeshShape>(&solid.shape);
    sphereTables_.push_back(settings.tabulated && sphere ? makeSphereTable(kernel_, sphere->radius) : SphereTable{});
    auto& field = meshFields_.emplace_back();
    if (mesh)
      if (auto made = MeshField::create(*mesh->mesh, kernel_)) field = *std::move(made);
  }
}

double ReferenceSolver::mass() const { return settings.density * std::pow(settings.spacing, 3); }

void ReferenceSolver::begin(double dt) {
  for (size_t i = 0; i < size(); ++i) {
    const bool placed = finite(state.position[i]);
    if (placed && finite(state.velocity[i])) continue;
    for (int a = 0; a < 3 && !placed; ++a) state.position[i][a] = std::isfinite(settings.lo[a]) ? settings.lo[a] : 0;
    deactivate(i);
  }
  if (state.concentration.empty())
    for (size_t k = 0; k < settings.fluids.size(); ++k) {
      if (!(settings.fluids[k].diffusion > 0)) continue;
      std::vector<double>& share = state.concentration.emplace_back();
      for (const uint8_t fluid : state.fluid) share.push_back(fluid == k ? 1 : 0);
    }
  if (initialPressureStep_ > 0) return predict(initialPressureStep_, dt);
  state.predicted = state.position;
  step_ = 0;
  updateRestFactor();
  density();
  predict(dt, dt);
}

void ReferenceSolver::solveInitialPressure(double dt, double momentum, int iterations) {
  updateRestFactor();
  const double omega = std::lerp(settings.relaxation, settings.relaxationAtRest, restFactor_);
  std::vector<double> change(size(), 0);
  state.predicted = state.position;
  density();
  for (int iteration = 0; iteration < iterations; ++iteration) {
    predictPositions(dt, true);
    density();
    bodies_.forgetPrediction();
    for (size_t i = 0; i < size(); ++i) {
      const double before = state.warm[i], extrapolated = std::min(0.0, before + momentum * change[i]);
      state.warm[i] = std::min(0.0, extrapolated - omega * (densityRatio_[i] - 1) / denominator_[i]);
      change[i] = state.warm[i] - before;
    }
  }
  initialPressureStep_ = dt;
}

void ReferenceSolver::substep(double dt, double dtNext) {
  const auto done = [this](Stage stage) {
    if (onStage) onStage(stage);
  };
  blockStart_ = substepsOfBlock_ == 0;
  impulses_ = applied_ = warmImpulses_;
  rejected_.assign(size(), glm::dvec3(0));
  rejectedBefore_ = rejected_;
  blockTime_ += dt;
  if (blockStart_) coherence_.assign(size(), 0);
  const double gravity = glm::length(settings.gravity);
  for (size_t i = 0; i < size(); ++i)
    backgroundShare_[i] = backgroundShare(glm::length(state.velocity[i]), coherence_[i], gravity, settings.spacing, kernel_.h());
  const double push = std::min(artificial_.rate * dt * dt, artificial_.most);
  for (int iteration = 0; iteration < settings.iterations; ++iteration) {
    firstIteration_ = iteration == 0;
    density();
    done(Stage::Density);
    multipliers(iteration == 0);
    done(Stage::Multipliers);
    correction(dt, iteration + 1 == settings.iterations ? push : 0);
    done(Stage::Correction);
    if (iteration + 1 == settings.iterations) break;
    addContributions(dt, {});
    moveBodies(dt);
  }
  firstIteration_ = true;
  updateRestFactor();
  planBlock(dt, dtNext);
  velocities(dt);
  done(Stage::Velocities);
  if (settings.viscosity > 0) {
    viscosity(dt);
    done(Stage::Viscosity);
  }
  if (blockStart_) {
    if (settings.viscosityAtRest > 0) {
      dampNoise(dt, blockTime_);
      done(Stage::NoiseDamping);
    }
    if (!state.concentration.empty()) {
      diffuse(blockTime_);
      done(Stage::Diffusion);
    }
    blockTime_ = 0;
  }
  if (settings.vorticity > 0) {
    vorticity(dt);
    done(Stage::Vorticity);
  }
  if (settings.drag > 0) {
    drag(dt);
    done(Stage::Drag);
  }
  if (settings.surfaceTension > 0) {
    surfaceTension(dt);
    done(Stage::SurfaceTension);
  }
  keepMouthsFree(dt);
  predict(dt, dtNext);
  done(Stage::Prediction);
}

void ReferenceSolver::addSpeed(double speed) {
  fastest_ = std::max(fastest_, speed);
  squares_ += std::min(speed * speed, kMaxMotion * glm::length(settings.gravity) * settings.spacing);
}

// Uses the speeds at the start of the substep.
void ReferenceSolver::updateRestFactor() {
  const double flow =
      std::min(std::max(fastest_, emitterSpeed()), kFlowTimes * std::sqrt(squares_ / static_cast<double>(std::max<size_t>(size(), 1))));
  const double fraction = settings.motionSpeed > 0 ? std::min(flow / settings.motionSpeed, 1.0) : 1;
  restFactor_ = 1 - std::pow(fraction, 4);
}

// A block ends early where the device has to rebuild its neighbor list.
void ReferenceSolver::planBlock(double dt, double dtNext) {
  const double speed = std::max(fastest_, emitterSpeed()) + std::max(settings.solidSpeed, bodies_.fastest());
  travel_ += speed * dt;
  const bool due = travel_ + (speed + glm::length(settings.gravity) * dtNext) * dtNext >
                   settings.travelLimit * std::lerp(1.0, double{kTravelAtRest}, restFactor_);
  substepsOfBlock_ = due ? 0 : (substepsOfBlock_ + 1) % settings.substepsPerBlock;
  if (due) travel_ = 0;
}

double ReferenceSolver::inverseMass(size_t i) const {
  return settings.fluids.empty() ? 1 : settings.density / settings.fluids[state.fluid[i]].density;
}

void ReferenceSolver::predict(double dt, double dtNext) {
  const double scale = (dtNext / dt) * (dtNext / dt);
  for (double& w : state.warm) w *= scale;
  for (size_t i = 0; i < size(); ++i) lastChange_[i] = scale * lambdaChange_[i];
  predictPositions(dtNext, false);
  step_ = dtNext;
}

void ReferenceSolver::predictPositions(double dt, bool atRest) {
  const std::vector<Pose> solids = poses(time_, atRest ? 0 : dt);
  warmImpulses_.assign(settings.solids.size(), {});
  const AddReaction add = addTo(warmImpulses_, densityPoses_, 1 / dt), pushed = addTo(warmImpulses_, solids, 1 / dt);
  for (size_t i = 0; i < size(); ++i) {
    const glm::dvec3 v = atRest ? glm::dvec3(0) : state.velocity[i];
    glm::dvec3 push = state.warm[i] * ownGradient(i);
    for (const Pair& pair : pairs(i)) push += (state.warm[i] + state.warm[pair.j]) * (pairScale(i, pair) * pair.gradient);
    addReactions(i, state.warm[i], densityPoses_, add);
    const glm::dvec3 x = state.position[i] + dt * (v + dt * settings.gravity) + inverseMass(i) * push;
    planned_[i] = x - state.position[i];
    if (finite(x)) {
      predictionPush_[i] = 0;
      const AddReaction weighed = [&](size_t n, const glm::dvec3& by, const glm::dvec3& at) {
        pushed(n, by / inverseMass(i), at);
        predictionPush_[i] += glm::length(by);
      };
      state.predicted[i] = collide(x, solids, weighed, atRest);  // the density that a body displaces is enough
    } else {
      deactivate(i);
    }
  }
  if (!bodies_.any()) return;
  bodies_.predict(time_, dt, settings.gravity, warmImpulses_, settings.pulls, solids, atRest,
                  [this](size_t n, const Pose& pose, const glm::dvec3& x) { return surfaceOf(n, pose, x); });
}

void ReferenceSolver::deactivate(size_t i) {
  state.predicted[i] = state.position[i];
  state.velocity[i] = glm::dvec3(0);
  state.warm[i] = 0;
  ++inactive_;
}

}  // namespace rill::reference
