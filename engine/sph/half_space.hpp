#pragma once
// The density that a half-space displaces: the building block of solids. Behind its surface at distance s lie ghost layers of the rest
// lattice at s + d/2 + k d, k >= 0, aligned with the particle, so that a lattice beside it has rest density.
#include <cstdint>
#include <vector>

#include "sph/kernel.hpp"

namespace rill {

/// A function of one distance and its derivative.
struct LineSample {
  double value = 0;  ///< dimensionless
  double slope = 0;  ///< 1/m, d value / d distance
};

/// Largest distance at which a solid displaces density: h - d/2, m.
double solidReach(const SmoothingKernel& kernel);

/// G1(s): contribution of ghost layers behind a plane at distance s (m, >= 0), by lattice sums.
LineSample exactPlane(const SmoothingKernel& kernel, double s);

/// F(s): contribution of a half-space at signed distance s (m), 1 deep inside.
///   F(s) = G1(s) + (1/2 - G1(0)) (1 - 2s/d)^2 for 0 <= s < d/2,   G1(s) for s >= d/2,   1 - F(-s) for s < 0.
/// The second term makes F continuous at s = 0, since G1(0) < 1/2 (0.486 at h = 2 d, 0.30 at 1.2 d). It vanishes with its slope at d/2,
/// the smallest distance of centers.
LineSample halfSpace(const SmoothingKernel& kernel, double s);

/// Table of F for linear interpolation, as in the shaders. Odd multiples of d/2 are nodes, so that the rest lattice is exact.
/// Node i is at the distance i * step; the last two nodes and all beyond are 0. F(-s) = 1 - F(s), with the same slope.
struct HalfSpaceTable {
  double step = 0;           ///< m, d / 16
  uint32_t nodes = 0;        ///< of `table`
  std::vector<float> table;  ///< element 2 n is the value of node n, 2 n + 1 its slope (1/m, <= 0)

  LineSample sample(double s) const;  ///< linear interpolation, any sign
};

HalfSpaceTable makeHalfSpaceTable(const SmoothingKernel& kernel);

}  // namespace rill
