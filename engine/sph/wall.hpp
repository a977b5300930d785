#pragma once
// The density of the fluid that walls displace, calibrated on the rest lattice: beside a wall, an edge and a corner it measures rho0 too.
//
// A wall at distance s carries ghost layers of the lattice at s + d/2 + k d, k >= 0, laterally in line with the particle (offsets a d).
// On each axis there are thus two sets of coordinates: L, the lattice in line with the particle, and B, the ghosts behind the axis' low and
// high wall. With S(T) the kernel's sum over the points whose coordinate is taken from B on the axes of T and from L on the others, the
// union of all walls is
//   value = S(x) + S(y) + S(z) - S(xy) - S(yz) - S(zx) + S(xyz).
// Independent half-spaces, the first three terms alone, count an edge twice and a corner three times.
#include <cstdint>
#include <vector>

#include "sph/kernel.hpp"

namespace rill {

/// What walls or solids add to a particle.
struct WallSample {
  double value = 0;                ///< to rho_i / rho0, dimensionless
  double gradient[3] = {0, 0, 0};  ///< 1/m, d value / d x_i, summed with the gradient kernel: it points toward the wall
  /// On each axis, the part of `value` that lies beside the particle, behind what is parallel to the axis, 0 to 1. The push of the fluid
  /// along the axis lacks it: of a pressure that changes linearly, sum_j (lambda_i + lambda_j) grad K_ij gives a share of 1 - beside (by
  /// partial integration, of the continuous kernel; on the rest lattice at h = 2d 0.873 for 0.876 at a wall, 0.756 for 0.765 in an edge).
  double beside[3] = {0, 0, 0};
};

/// A value that depends on one distance.
struct LineSample {
  double value = 0;  ///< dimensionless
  double slope = 0;  ///< 1/m, d value / d distance
};

/// The farthest distance at which a wall is felt: h - d/2, m.
double wallReach(const SmoothingKernel& kernel);

/// The lattice sums themselves. `lo`, `hi`: distances to the low and high wall of each axis, m; infinity where there is none; below 0 is
/// taken as 0.
WallSample exactWall(const SmoothingKernel& kernel, const double lo[3], const double hi[3]);

/// G1(s): one wall at distance s >= 0 alone, by lattice sums.
LineSample exactPlane(const SmoothingKernel& kernel, double s);

/// F(s): the share of the density that a half-space at signed distance s displaces, 1 deep inside it. What solids are made of.
///   F(s) = G1(s) + (1/2 - G1(0)) (1 - 2s/d)^2 for 0 <= s < d/2,   G1(s) for s >= d/2,   1 - F(-s) for s < 0.
/// Lattice sums give G1(0) = 0.486 at h = 2d (0.30 at 1.2d); the second term closes that step at s = 0 and is 0, with its slope, at d/2 and
/// beyond, where centers are.
LineSample halfSpace(const SmoothingKernel& kernel, double s);

/// The same sums on nodes, as the shaders interpolate them. Every odd multiple of d/2 is a node, so that a rest lattice stays exact.
/// Node i is at the distance i * step; the last two nodes are 0, and beyond them is 0. Slopes are derivatives by the distance, 1/m, <= 0.
/// Pairs (value, slope) are interleaved: element 2 n is node n's value, 2 n + 1 its slope by s1.
struct WallTables {
  double step = 0;            ///< m, between the nodes of `plane` and `edge`: d / 16
  double cornerStep = 0;      ///< m, between the nodes of `corner`: d / 8
  uint32_t nodes = 0;         ///< an axis, of `plane` and `edge`
  uint32_t cornerNodes = 0;   ///< an axis, of `corner`
  std::vector<float> plane;   ///< S of one axis: node i
  std::vector<float> face;    ///< F of halfSpace() for s >= 0: node i, as `plane`; F(-s) = 1 - F(s), with the same slope
  std::vector<float> edge;    ///< S of two axes: node i2 * nodes + i1; the slope by s2 is that at (s2, s1)
  std::vector<float> corner;  ///< S of three axes: node (i3 * cornerNodes + i2) * cornerNodes + i1; symmetric in s2 and s3

  LineSample samplePlane(double s) const;                           ///< linear, s >= 0
  LineSample sampleFace(double s) const;                            ///< linear, any sign
  LineSample sampleEdge(double s1, double s2) const;                ///< bilinear; the slope is the one by s1
  LineSample sampleCorner(double s1, double s2, double s3) const;   ///< trilinear; the slope is the one by s1
  WallSample sample(const double lo[3], const double hi[3]) const;  ///< as exactWall
};

WallTables makeWallTables(const SmoothingKernel& kernel);

}  // namespace rill
