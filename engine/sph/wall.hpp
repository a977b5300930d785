#pragma once
// Density contribution of plane walls, calibrated so that the rest lattice has rest density at walls, edges and corners too.
//
// Behind a wall at distance s lie ghost layers of the lattice at s + d/2 + k d, k >= 0, aligned with the particle (offsets a d). Each axis
// has two sets of coordinates: L, the lattice aligned with the particle, and B, the ghosts behind its low and high wall. S(T) is the sum of
// the kernel over points with coordinates from B on the axes in T and from L on the others. By inclusion and exclusion, all walls give
//   value = S(x) + S(y) + S(z) - S(xy) - S(yz) - S(zx) + S(xyz).
// The first three terms alone would count edges twice and corners three times.
#include <cstdint>
#include <vector>

#include "sph/kernel.hpp"

namespace rill {

/// Contribution of walls or solids to a particle.
struct WallSample {
  double value = 0;              ///< added to rho_i / rho0, dimensionless
  Double3 gradient = {0, 0, 0};  ///< 1/m, d value / d x_i with the gradient kernel; points toward the wall
  /// The symmetric tensor sum of value (1 - n n^T) over walls with normals n. The pressure force along a wall lacks it: for a linear
  /// pressure, sum_j (lambda_i + lambda_j) grad K_ij has the fraction 1 - wallCoverage (integration by parts, continuous kernel).
  Double3 wallCoverage = {0, 0, 0};       ///< xx, yy, zz
  Double3 wallCoverageMixed = {0, 0, 0};  ///< yz, zx, xy; 0 where all walls are along the axes

  /// Adds the coverage of a surface that displaces `displaced`, with a normal of this direction (of any length).
  void cover(double displaced, const Double3& direction);
};

/// What walls do to a correction: the neighbors' share is multiplied by this symmetric matrix, (1 - wallCoverage)^-1.
struct WallScale {
  Double3 diagonal = {1, 1, 1};  ///< xx, yy, zz
  Double3 mixed = {0, 0, 0};     ///< yz, zx, xy
};

/// Eigenvalues of the coverage are bounded by kMaxWallCoverage: axis by axis where walls are along the axes, else by a common factor.
WallScale wallScale(const WallSample& sample);

/// A function of one distance and its derivative.
struct LineSample {
  double value = 0;  ///< dimensionless
  double slope = 0;  ///< 1/m, d value / d distance
};

/// Largest distance at which a wall contributes: h - d/2, m.
double wallReach(const SmoothingKernel& kernel);

/// The contribution of all walls by lattice sums. `lo`, `hi`: distances to the low and high wall of each axis, m, clamped to >= 0; infinity
/// without a wall.
WallSample exactWall(const SmoothingKernel& kernel, const Double3& lo, const Double3& hi);

/// G1(s): contribution of a single wall at distance s (m, >= 0), by lattice sums.
LineSample exactPlane(const SmoothingKernel& kernel, double s);

/// F(s): contribution of a half-space at signed distance s (m), 1 deep inside. The building block of solids.
///   F(s) = G1(s) + (1/2 - G1(0)) (1 - 2s/d)^2 for 0 <= s < d/2,   G1(s) for s >= d/2,   1 - F(-s) for s < 0.
/// The second term makes F continuous at s = 0, since G1(0) < 1/2 (0.486 at h = 2 d, 0.30 at 1.2 d). It vanishes with its slope at d/2,
/// the smallest distance of centers.
LineSample halfSpace(const SmoothingKernel& kernel, double s);

/// Tables of the sums for linear interpolation, as in the shaders. Odd multiples of d/2 are nodes, so that the rest lattice is exact.
/// Node i is at the distance i * step; the last two nodes and all beyond are 0. Slopes are derivatives by the distance, 1/m, <= 0.
/// Interleaved: element 2 n is the value of node n, 2 n + 1 its slope by s1.
struct WallTables {
  double step = 0;            ///< m, between the nodes of `plane` and `edge`: d / 16
  double cornerStep = 0;      ///< m, between the nodes of `corner`: d / 8
  uint32_t nodes = 0;         ///< per axis, of `plane` and `edge`
  uint32_t cornerNodes = 0;   ///< per axis, of `corner`
  std::vector<float> plane;   ///< S of one axis: node i
  std::vector<float> face;    ///< F of halfSpace() for s >= 0: node i, as `plane`; F(-s) = 1 - F(s), with the same slope
  std::vector<float> edge;    ///< S of two axes: node i2 * nodes + i1; the slope by s2 is the one at (s2, s1)
  std::vector<float> corner;  ///< S of three axes: node (i3 * cornerNodes + i2) * cornerNodes + i1; symmetric in s2 and s3

  LineSample samplePlane(double s) const;                          ///< linear interpolation, s >= 0
  LineSample sampleFace(double s) const;                           ///< linear interpolation, any sign
  LineSample sampleEdge(double s1, double s2) const;               ///< bilinear; the slope is the one by s1
  LineSample sampleCorner(double s1, double s2, double s3) const;  ///< trilinear; the slope is the one by s1
  WallSample sample(const Double3& lo, const Double3& hi) const;   ///< as exactWall
};

WallTables makeWallTables(const SmoothingKernel& kernel);

}  // namespace rill
