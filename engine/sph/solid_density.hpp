#pragma once
// Density contribution of spheres and boxes, built from that of a half-space, F in half_space.hpp.
#include <cstdint>
#include <vector>

#include "shape/shape.hpp"
#include "sph/half_space.hpp"
#include "sph/solid_scale.hpp"

namespace rill {

/// Density contribution of a sphere of radius R at signed distance s (negative inside):
///   B(s) = F(s) * I_ball(s) / I_half(s),
/// where I is the integral of the kernel over the sphere, and over the half-space that touches it at the closest point:
///   I(s) = int_0^h K(rho) 4 pi rho^2 f(rho) d rho, with the fraction f of the shell of radius rho inside the body,
///   f = (1 - clamp(c, -1, 1)) / 2,  c_half = s / rho,  c_ball = (s (2R + s) + rho^2) / (2 (R + s) rho).
/// For large R the ratio tends to 1 and B to the plane wall. The slope is F' I_ball/I_half + F (I_ball/I_half)'.
LineSample exactSphere(const SmoothingKernel& kernel, double R, double s);

/// Table of B at the distances first + i * step; (value, slope) interleaved; the last two nodes are 0. Distances below `first`
/// (= -min(R, h - d/2), rounded toward 0 to a node) use the first node.
struct SphereTable {
  double first = 0;  ///< m, <= 0
  double step = 0;   ///< m, d / 16
  uint32_t nodes = 0;
  std::vector<float> table;

  LineSample sample(double s) const;  ///< linear interpolation
};

/// `R`: radius, m, > 0. The table is shared by all spheres of this radius.
SphereTable makeSphereTable(const SmoothingKernel& kernel, double R);

/// Density contribution of a box centered on 0 with half extents `half` (m) at `local` (m), both in the frame of the box: the product
/// over the axes of the contribution of a slab,
///   P_a = clamp(F(|x_a| - half_a) - F(|x_a| + half_a), 0, 1),  dP_a/dx_a = sign(x_a) (F'(|x_a| - half_a) - F'(|x_a| + half_a)).
/// Faces of thick and wide boxes equal the plane wall from d/2 on. The gradient is in the frame of the box; `coverage` is 0, since it
/// refers to the axes of the scene.
SolidSample boxSample(const SmoothingKernel& kernel, const Double3& local, const Double3& half);

/// The same with F from the table, as in the shaders.
SolidSample boxSample(const HalfSpaceTable& table, const Double3& local, const Double3& half);

/// Density contribution of a sphere or box at `local`; gradient and `local` are in its frame, `coverage` is 0. That of a mesh is in
/// mesh_field.hpp.
SolidSample solidSample(const SmoothingKernel& kernel, const Shape& shape, const Double3& local);

/// The same from the tables. `sphere`: of its radius, if the shape is a sphere.
SolidSample solidSample(const HalfSpaceTable& table, const SphereTable& sphere, const Shape& shape, const Double3& local);

}  // namespace rill
