#pragma once
// The surface of particles as a triangle mesh: shaders/mesher in double precision. Lengths are in spacings.
//
// A particle is an ellipsoid with a kernel whose sum over a plane of particles is the quadratic B-spline: 1/2 at half a spacing, 0 from
// one and a half on. So the sum over any number of parallel layers is 1/2 half a spacing outside the outermost one. Ellipsoids are
// longer along directions in which particles lie (Yu and Turk 2013), which smooths the surface without moving it.
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rill::reference {

/// A particle's kernel: amplitude * W(|toKernel (x - center)|).
struct Ellipsoid {
  glm::dvec3 center{0};
  glm::dmat3 toKernel{1};  ///< symmetric
  double amplitude = 1;
  double radius = 0;     ///< of a sphere around its support
  bool surface = false;  ///< not deep inside the fluid
};

/// The kernel over the spacing's cube, of a distance in spacings.
double meshKernel(double r);
/// Its derivative over the distance.
double meshKernelSlope(double r);
/// The signed distance (below 0: inside) to a plane surface where the sum of kernels is `sum`.
double meshDistance(double sum);

std::vector<Ellipsoid> ellipsoids(std::span<const glm::dvec3> positions);

struct FieldValue {
  double sum = 0;
  glm::dvec3 slope{0};
  glm::dvec3 velocity{0};  ///< mean, with the kernels as weights
};

struct SurfaceMesh {
  std::vector<glm::dvec3> positions, normals, velocities;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// `cell`: side of the grid's cells. The grid's points lie at whole multiples of it. `velocities`: as many as positions.
SurfaceMesh surfaceMesh(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities, double cell);

/// Sum of kernels at a point.
FieldValue fieldAt(std::span<const Ellipsoid> particles, std::span<const glm::dvec3> velocities, const glm::dvec3& point);

/// The volume that a closed mesh encloses.
double enclosedVolume(const SurfaceMesh& mesh);

}  // namespace rill::reference
