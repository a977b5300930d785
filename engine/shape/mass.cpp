#include "shape/mass.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/overloaded.hpp"
#include "core/vector_math.hpp"

namespace rill {
namespace {

/// From the second moments about the center of mass, int x_a x_b dm: xx, yy, zz, yz, zx, xy.
std::array<double, 6> inertiaFrom(const std::array<double, 6>& moments) {
  const double trace = moments[0] + moments[1] + moments[2];
  return {trace - moments[0], trace - moments[1], trace - moments[2], -moments[3], -moments[4], -moments[5]};
}

MassProperties massOf(const BoxShape& box, double density) {
  const Double3 half = halfExtents(box);
  MassProperties m{.mass = density * volumeOf(box)};
  m.inertia = inertiaFrom({m.mass / 3 * half.x * half.x, m.mass / 3 * half.y * half.y, m.mass / 3 * half.z * half.z, 0, 0, 0});
  return m;
}

MassProperties massOf(const SphereShape& sphere, double density) {
  MassProperties m{.mass = density * volumeOf(sphere)};
  const double moment = m.mass * sphere.radius * sphere.radius / 5;
  m.inertia = inertiaFrom({moment, moment, moment, 0, 0, 0});
  return m;
}

MassProperties massOf(const MeshShape& shape, double density) {
  constexpr size_t kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
  double volume = 0;
  Double3 first = {0, 0, 0};
  std::array<double, 6> second{};
  const MeshData& data = shape.mesh->data();
  for (const auto& triangle : data.triangles) {
    const Double3 &a = data.vertices[triangle[0]], &b = data.vertices[triangle[1]], &c = data.vertices[triangle[2]];
    const double sixfold = dot(a, cross(b, c));
    volume += sixfold / 6;
    for (size_t i = 0; i < 3; ++i) first[i] += sixfold / 24 * (a[i] + b[i] + c[i]);
    for (size_t k = 0; k < 6; ++k) {
      const size_t i = kPairs[k][0], j = kPairs[k][1];
      const double sum = (a[i] + b[i] + c[i]) * (a[j] + b[j] + c[j]) + a[i] * a[j] + b[i] * b[j] + c[i] * c[j];
      second[k] += sixfold / 120 * sum;
    }
  }
  MassProperties m{.mass = density * volume};
  for (size_t i = 0; i < 3; ++i) m.center[i] = first[i] / volume;
  std::array<double, 6> central{};
  for (size_t k = 0; k < 6; ++k) central[k] = density * (second[k] - volume * m.center[kPairs[k][0]] * m.center[kPairs[k][1]]);
  m.inertia = inertiaFrom(central);
  return m;
}

}  // namespace

MassProperties massOf(const Shape& shape, double density) {
  return std::visit([&](const auto& s) { return massOf(s, density); }, shape);
}

MassProperties massOf(const Solid& solid, const MassProperties& unit) {
  assert(solid.body);
  const double density = solid.body->mass > 0 ? solid.body->mass / unit.mass : solid.body->density;
  MassProperties m = unit;
  m.mass *= density;
  for (double& moment : m.inertia) moment *= density;
  return m;
}

MassProperties massOf(const Solid& solid) { return massOf(solid, massOf(solid.shape, 1)); }

Pose poseOfSolid(const Shape& shape, const Pose& centerOfMass) {
  Pose pose = centerOfMass;
  const Double3 toCenter = toScene(pose, along({}, -1, massOf(shape, 1).center));
  pose.center = along(pose.center, 1, toCenter);
  pose.velocity = along(pose.velocity, 1, cross(pose.angularVelocity, toCenter));
  return pose;
}

double radiusAbout(const Shape& shape, const Double3& center) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  if (!mesh) return boundingRadius(shape) + length(center);
  double radius = 0;
  for (const Double3& vertex : mesh->mesh->data().vertices) radius = std::max(radius, length(minus(vertex, center)));
  return radius;
}

}  // namespace rill
