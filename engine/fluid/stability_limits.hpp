#pragma once
// The longest steps and the largest gains at which a fluid gains no energy. See docs/notes/time-step-and-substeps.md and
// docs/notes/noise-damping.md.
#include <cstdint>

#include "rill/scene.hpp"
#include "sph/kernel.hpp"

namespace rill {

/// Mean compression by its own weight at which one iteration is stable. 0.007 held, 0.013 exploded (dam10k without warm start).
inline constexpr double kStableError = 0.0055;

/// m^2/s^2: gravity times the height of a column as high as `extent` (m), which sets its pressure.
double columnHead(const Scene& scene, const Double3& extent);

/// Whether a scene asks for more than is stable, what it asks for, and what is taken.
struct Bounded {
  double wanted = 0, taken = 0;
};
/// epsilon, a fraction of the rest lattice's D.
Bounded boundedRegularization(const Scene& scene);
/// kappa of a fluid in motion: as much of it as waves are stable at.
Bounded boundedWarmGain(const Scene& scene);

/// Limits of a scene's fluid. `head`: see columnHead(). The device evaluates the same formulas for the fluid as it is:
/// shaders/fluid/stability.glsl.
struct StabilityLimits {
  // As the device gets them.
  float relaxationAtRest = 0, relaxationInMotion = 0;  ///< omega
  float warmGainInMotion = 0;                          ///< kappa
  double relaxationWanted = 0, relaxationLimit = 0;    ///< what the scene or its default asks for, and what converges
  double softness = 1;             ///< what the default regularization leaves of a correction at rest, over what the scene's does
  double stableStep = 0;           ///< m: times 1 / sqrt(head) the longest step
  double toleratedStep = 0;        ///< m: likewise the first step; infinite without a tolerance
  double layerHead = 0;            ///< m^2/s^2, of a column of one layer
  double motionShare = 0;          ///< motionSpeed() over the speed of falling through the column
  double maxWarmGainAtRest = 0;    ///< kappa at rest, and
  double layerWarmGainAtRest = 0;  ///< this over the square of the column's layers, if that is less

  double layers(double head) const { return head / layerHead; }
  /// s. A column that its weight compresses by too much in a step folds, and springs back with more energy than it had.
  double longestStep(double head) const;
  /// s. A fluid that is released without its pressure compresses, and springs back with what a long step left.
  double firstStep(double head) const;
  double warmGainAtRest(double head) const;        ///< kappa
  double motionSpeed(double head) const;           ///< m/s of the fastest particle, from which on a fluid is no longer at rest
  double errorRateShareAtRest(double head) const;  ///< of a substep in the means of error and step
};
StabilityLimits stabilityLimits(const Scene& scene, const SmoothingKernel& kernel);

/// The initial pressure: see engine/sph/start_pressure.hpp.
struct InitialPressure {
  uint32_t iterations = 0;  ///< 0: none
  double momentum = 0;
  double step = 0;        ///< s
  double errorLimit = 0;  ///< mean compression up to which it is looked for
};
/// `room`: the widest extent that positions have, m.
InitialPressure initialPressure(const Scene& scene, const SmoothingKernel& kernel, const StabilityLimits& limits, double head, double room);

/// Bounds on what a substep does to speeds.
struct SpeedLimits {
  double warm = 0;                  ///< m^2/s^2: the warm start is at most this times the step squared
  double minGain = 0, maxGain = 0;  ///< m/s that a correction may add
  double speed = 0;                 ///< m/s, of any particle
};
/// `extent` (m) and `fastest` (m/s): of the particles at the start; `solids`: m/s of the fastest solid.
SpeedLimits speedLimits(const Scene& scene, const Double3& extent, double fastest, double solids);

}  // namespace rill
