#pragma once
// The density of the fluid that solid balls and boxes displace, made of the half-space share F of wall.hpp.
#include <cstdint>
#include <vector>

#include "sph/wall.hpp"

namespace rill {

/// A ball of radius R whose surface is at signed distance s (negative inside) from the particle:
///   B(s) = F(s) * I_ball(s) / I_half(s),
/// I the kernel's continuous integral over the ball and over the half-space whose plane touches it nearest the particle:
///   I(s) = int_0^h K(rho) 4 pi rho^2 f(rho) d rho, with the share f of the sphere of radius rho that lies in the body,
///   f = (1 - clamp(c, -1, 1)) / 2,  c_half = s / rho,  c_ball = (s (2R + s) + rho^2) / (2 (R + s) rho).
/// The ratio goes to 1 for large R, so that B goes to the plane wall. The slope is F' I_ball/I_half + F (I_ball/I_half)'.
LineSample exactSphere(const SmoothingKernel& kernel, double R, double s);

/// B on nodes at first + i * step; (value, slope) interleaved; the last two nodes are 0. Below `first` (= -min(R, h - d/2), rounded toward
/// 0 to a node) the first node holds.
struct SphereTable {
  double first = 0;  ///< m, <= 0
  double step = 0;   ///< m, d / 16
  uint32_t nodes = 0;
  std::vector<float> table;

  LineSample sample(double s) const;  ///< linear
};

/// `R`: radius, m, > 0. One table serves all balls of that radius.
SphereTable makeSphereTable(const SmoothingKernel& kernel, double R);

/// An axis-aligned box centered on 0 with half extents `half` (m), seen from `local` (m, in the box' frame). The product over the axes of
/// the slab's share
///   P_a = clamp(F(|x_a| - half_a) - F(|x_a| + half_a), 0, 1),  dP_a/dx_a = sign(x_a) (F'(|x_a| - half_a) - F'(|x_a| + half_a)).
/// From d/2 on, a thick and wide box' face is the plane wall; a thin plate displaces what it holds. The gradient is in the box' frame;
/// `beside` is left 0, since it goes by the axes of the world.
WallSample boxSample(const SmoothingKernel& kernel, const double local[3], const double half[3]);

/// The same with F from the tables, as the shaders do it.
WallSample boxSample(const WallTables& tables, const double local[3], const double half[3]);

}  // namespace rill
