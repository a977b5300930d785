#pragma once
#include "sph/kernel.hpp"

namespace rill {

/// Artificial pressure s_corr of Macklin and Mueller 2013 (eq. 13), which separates close pairs where the density is below rest density.
/// A step dt adds -min(rate dt^2, most) factor(K) / D to the sum of a pair's multipliers, where D is the rest lattice's sum of |grad K|^2.
///
/// The paper applies k once per iteration, so its effect depends on the number of steps. Here it is an acceleration: at strength 1 and
/// distance delta q, 28.7 times 9.81 m/s^2 at the steepest point of the kernel, for all kernels, spacings and steps. This equals the
/// paper's k = 0.1 with four iterations of 1/120 s at d = 0.05 m and h = 2 d.
struct ArtificialPressure {
  /// `strength`: 0 .. 1. `radius`: delta q / h, 0 .. 1 exclusive. `power`: n, >= 1.
  ArtificialPressure(const SmoothingKernel& kernel, double strength, double radius, double power);

  /// clamp(K / K(delta q), least, 1)^n - least^n for a pair with kernel value K, 0 .. 1; 0 for neighbors at rest.
  double factor(double value) const;

  double rate;     ///< 1/s^2; 0 if delta q is not below the distance of neighbors at rest
  double most;     ///< dimensionless upper limit, which displaces each particle by spacing / 20
  double inverse;  ///< 1 / K(delta q)
  double power;    ///< n
  double least;    ///< K / K(delta q) at 0.95 d, at most 1
};

}  // namespace rill
