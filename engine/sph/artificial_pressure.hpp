#pragma once
#include "sph/kernel.hpp"

namespace rill {

/// s_corr of Macklin and Mueller 2013 (equation 13), which parts pairs that come too near each other where density is too low to: a step of
/// dt that makes up for a time T adds -min(rate T^2, most) dt / T share(K) / D to the sum of a pair's multipliers, D being the rest
/// lattice's sum of |grad K|^2.
///
/// The paper's k acts once an iteration, so that its push grows with the number of steps a second. Here it is an acceleration: at strength
/// 1 each particle of a pair at delta q leaves the other with 28.7 times 9.81 m/s^2 where the kernel is steepest, whatever kernel, spacing,
/// step and the scene's gravity, which is what the paper's k = 0.1 gives in four iterations of 1/120 s at d = 0.05 m and h = 2 d. It does
/// not grow with the flow: its work is of the order of g d.
struct ArtificialPressure {
  /// `strength`: 0 .. 1; `radius`: delta q / h, 0 .. 1 exclusive; `power`: n, >= 1.
  ArtificialPressure(const SmoothingKernel& kernel, double strength, double radius, double power);

  /// Of a pair whose kernel value is K: min(1, K / K(delta q))^n less what it is for neighbors at rest, 0 .. 1. They are not touched.
  double share(double value) const;

  double rate;     ///< 1/s^2; 0 where delta q is as far as neighbors at rest, who leave nothing to push
  double most;     ///< dimensionless: what parts each of a pair by a twentieth of a spacing
  double inverse;  ///< 1 / K(delta q)
  double power;    ///< n
  double atRest;   ///< what is taken off: (K / K(delta q))^n at 0.95 d, at most 1
};

}  // namespace rill
