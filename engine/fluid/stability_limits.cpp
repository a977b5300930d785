#include "fluid/stability_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vector_math.hpp"
#include "fluid/fluids.hpp"
#include "fluid/numbers.hpp"
#include "model/scene_facts.hpp"
#include "shared/fluid_records.h"
#include "sph/jacobi_limit.hpp"
#include "sph/start_pressure.hpp"

namespace rill {
namespace {

// At most; more brings nothing even where it converges.
constexpr double kRelaxation = 0.7;
// Of the linear limit, which is that of a lattice: disorder is stiffer.
constexpr double kOfJacobiLimit = 0.92;
// And at rest, where a correction is a speed in the next substep: see docs/notes/noise-damping.md (2).
constexpr double kOfJacobiLimitAtRest = 0.6;

// Of the rest lattice's sum |grad C|^2: bounds the correction of isolated pairs.
constexpr double kRegularization = 0.02;
constexpr double kWarmGain = 0.02;
// Poly6 with spiky does work in loops. At these two a wave breaks faster than that feeds it; at 5, and at a gain of 0.5, energy grew by a
// sixth: see docs/notes/kernel-choice.md.
constexpr double kMaxRegularizationPoly6Spiky = 1, kMaxWarmGainPoly6Spiky = 0.02;
// At rest, over the square of the column's layers, and at most: its longest wave gains kappa / 2 a substep.
constexpr double kWarmGainAtRest = 1.2, kMaxWarmGainAtRest = 0.005;
// With this kappa pressure still followed a dam's flow; without one the start's would stay for ever.
constexpr double kMinFollowing = 0.001;

// motionSpeed over the speed of falling through the column: see docs/notes/noise-damping.md. Between fluids it follows the root of the
// difference of their densities, which drives them. What is less would take for a flow the noise of a fluid whose noise is not damped.
constexpr double kMotionShare = 0.5, kMinMotionShare = 0.2;

// How much less error is stable with a warm start: at 0.05 0.0032 held, 0.0036 gained a quarter of energy; at 0.02 0.0036 gained 2.5 %.
constexpr double kStableGain = 40;
// Mean compression of a column, over that of one which rests on its corrections alone (see stepOfError).
constexpr double kErrorOfHead = 0.38;

// w is -p dt^2 / rho for a pressure p: twice that of water as high as the room.
constexpr double kWarmLimit = 1;
// Of the usual speed: what a correction may always add, and never more than. See docs/notes/overlaps.md.
constexpr double kMinSpeedGain = 0.06, kMaxSpeedGain = 0.5;
// Of the usual speed: jets at walls reach two or three times that.
constexpr double kSpeedLimit = 8;

double wantedWarmGain(const Scene& scene) { return scene.solver.warm_start.value_or(scene.solver.iterations == 1 ? kWarmGain : 0.0); }

// epsilon stands beside D in what divides a correction.
double softnessOf(const Scene& scene) {
  return (1 + std::max(boundedRegularization(scene).taken, kRegularization)) / (1 + kRegularization);
}

// The step in which the mean compression of a column is `error`, times the root of its head. Corrections hold a column up where
// 2 omega / D grad C = g dt^2, so that C is D d^2 / (4 omega) at rest, over dt^2 g H / d^2; in the dam breaks of assets/scenes it is less,
// 0.06 at h = 2 d.
double stepOfError(const SmoothingKernel& kernel, double error, double relaxation) {
  const double d = kernel.spacing();
  // With a short support the gradients grow as soon as particles come nearer.
  double gradients = kernel.restGradientSum();
  for (const double nearer : {1.1, 1.2, 1.3})
    gradients = std::max(gradients, SmoothingKernel(kernel.choice(), nearer * kernel.h(), d).restGradientSum());
  return d * std::sqrt(error / (kErrorOfHead * gradients * d * d / (4 * relaxation)));
}

double stableStepOf(const SmoothingKernel& kernel, const StabilityLimits& limits, uint32_t iterations, double gain) {
  const double error = kStableError * iterations / (1 + kStableGain * limits.softness * gain);
  return stepOfError(kernel, error, limits.relaxationInMotion / limits.softness);
}

}  // namespace

double columnHead(const Scene& scene, const Double3& extent) {
  double head = 0;
  for (int a = 0; a < 3; ++a) head += strongestGravity(scene, a) * std::max(extent[a], scene.fluid.spacing);
  return head;
}

Bounded boundedRegularization(const Scene& scene) {
  const double wanted = scene.solver.regularization.value_or(kRegularization);
  return {wanted, scene.solver.kernel == KernelChoice::Poly6Spiky ? std::min(wanted, kMaxRegularizationPoly6Spiky) : wanted};
}

// A wave is fed where its correction is the smaller.
Bounded boundedWarmGain(const Scene& scene) {
  const double wanted = wantedWarmGain(scene);
  const double most = scene.solver.kernel == KernelChoice::Poly6Spiky ? kMaxWarmGainPoly6Spiky : wanted;
  return {wanted, std::min(wanted, most) / softnessOf(scene)};
}

StabilityLimits stabilityLimits(const Scene& scene, const SmoothingKernel& kernel) {
  const double most = maxJacobiRelaxation(kernel), gain = boundedWarmGain(scene).taken;
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  StabilityLimits limits;
  limits.relaxationLimit = kOfJacobiLimit * most;
  limits.relaxationWanted = scene.solver.relaxation.value_or(std::min(kRelaxation, limits.relaxationLimit));
  limits.relaxationInMotion = f(std::min(limits.relaxationWanted, limits.relaxationLimit));
  limits.relaxationAtRest =
      scene.solver.relaxation ? limits.relaxationInMotion : f(std::min(limits.relaxationWanted, kOfJacobiLimitAtRest * most));
  limits.warmGainInMotion = f(gain);
  limits.softness = softnessOf(scene);
  limits.stableStep = stableStepOf(kernel, limits, scene.solver.iterations, limits.warmGainInMotion);
  // Half of what the tolerance allows: from the whole step on, a dam's worst particles are a quarter more compressed.
  const double tolerance = scene.solver.tolerance;
  limits.toleratedStep = tolerance > 0 ? 0.5 * stepOfError(kernel, tolerance, limits.relaxationAtRest / limits.softness) : kInfinite;
  limits.layerHead = std::max(strongestGravity(scene), 1e-20) * scene.fluid.spacing;
  limits.motionShare = f(std::max(kMotionShare * std::sqrt(leastDensityDifference(scene)), kMinMotionShare));
  limits.maxWarmGainAtRest = scene.solver.warm_start ? gain : std::min(gain, kMaxWarmGainAtRest);
  limits.layerWarmGainAtRest = scene.solver.warm_start ? kInfinite : kWarmGainAtRest;
  return limits;
}

double StabilityLimits::longestStep(double head) const { return stableStep / std::sqrt(head); }
double StabilityLimits::firstStep(double head) const { return toleratedStep / std::sqrt(head); }

double StabilityLimits::warmGainAtRest(double head) const {
  return std::min(maxWarmGainAtRest, layerWarmGainAtRest / (layers(head) * layers(head)));
}

double StabilityLimits::motionSpeed(double head) const { return motionShare * std::sqrt(2 * head); }

double StabilityLimits::errorRateShareAtRest(double head) const { return 1 / std::max(1.0, double{kErrorSubsteps} * layers(head)); }

// It is found for the longest step that is stable with the defaults: in shorter ones the rounding of positions hides it, in longer ones
// the column folds. Zero where no pressure is carried from substep to substep.
InitialPressure initialPressure(const Scene& scene, const SmoothingKernel& kernel, const StabilityLimits& limits, double head,
                                double room) {
  if (head <= 0 || limits.warmGainInMotion < f(kMinFollowing)) return {};
  const StartPressure start = startPressure(kernel, limits.relaxationAtRest, boundedRegularization(scene).taken, limits.layers(head),
                                            kMaxInitialPressureIterations);
  InitialPressure result{start.iterations, start.momentum, stableStepOf(kernel, limits, 1, kWarmGain / limits.softness) / std::sqrt(head),
                         0};
  // A compression e of a column as high as all the fluid would be released within a step, at e times its height over that step: at most a
  // twentieth of what falling through a spacing gives. And not below what rounding leaves of any start.
  const double g = strongestGravity(scene);
  const double noticed = 0.05 * std::sqrt(g * scene.fluid.spacing) * f(result.step) * g / head;
  result.errorLimit = std::max({noticed, 2.0e-6, 0x1p-24 * room / scene.fluid.spacing});
  return result;
}

// The usual speed: what falling through all the room gives, what the fluid started with, what solids push it with.
SpeedLimits speedLimits(const Scene& scene, const Double3& extent, double fastest, double solids) {
  Double3 room;
  const bool closed = scene.domain && scene.domain->open == 0;
  for (int a = 0; a < 3; ++a) room[a] = std::max(extent[a], scene.domain ? scene.domain->max[a] - scene.domain->min[a] : 0);
  const double capillary = std::sqrt(largestKinematicTension(scene) / scene.fluid.spacing);  // what tension adds in the longest step
  const double usual = std::sqrt(2 * columnHead(scene, room) + fastest * fastest) + solids + 2 * capillary;
  constexpr double kUnbounded = 1e18;  // m/s: through an open side fluid may fall any distance
  return {kWarmLimit * usual * usual, kMinSpeedGain * usual + capillary, closed ? kMaxSpeedGain * usual + capillary : kUnbounded,
          closed ? kSpeedLimit * usual : kUnbounded};
}

}  // namespace rill
