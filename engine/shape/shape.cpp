#include "shape/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/vector_math.hpp"
#include "shape/mesh_impl.hpp"

namespace rill {
namespace {

std::optional<double> ifAhead(double distance) { return distance > 0 ? std::optional(distance) : std::nullopt; }

}  // namespace

Double3 centerOf(const BoxShape& box) {
  Double3 center;
  for (size_t a = 0; a < 3; ++a) center[a] = (box.min[a] + box.max[a]) / 2;
  return center;
}
Double3 centerOf(const SphereShape& sphere) { return sphere.center; }
Double3 centerOf(const MeshShape&) { return {}; }

Double3 halfExtents(const BoxShape& box) {
  Double3 half;
  for (size_t a = 0; a < 3; ++a) half[a] = (box.max[a] - box.min[a]) / 2;
  return half;
}
Double3 halfExtents(const SphereShape& sphere) { return {sphere.radius, sphere.radius, sphere.radius}; }
Double3 halfExtents(const MeshShape& mesh) {
  const Double3 low = mesh.mesh->min(), high = mesh.mesh->max();
  return {(high.x - low.x) / 2, (high.y - low.y) / 2, (high.z - low.z) / 2};
}

Double3 middleOf(const Shape& shape) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  if (mesh == nullptr) return {};
  const Double3 low = mesh->mesh->min(), high = mesh->mesh->max();
  return {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
}

double shellOf(const Shape& shape, double spacing) {
  const auto* mesh = std::get_if<MeshShape>(&shape);
  return mesh != nullptr && mesh->two_sided ? 0.5 * spacing : 0;
}

double boundingRadius(const BoxShape& box) {
  const Double3 half = halfExtents(box);
  return std::sqrt(dot(half, half));
}
double boundingRadius(const SphereShape& sphere) { return sphere.radius; }
double boundingRadius(const MeshShape& mesh) { return implOf(*mesh.mesh).radius; }

double volumeOf(const BoxShape& box) {
  double volume = 1;
  for (size_t a = 0; a < 3; ++a) volume *= box.max[a] - box.min[a];
  return volume;
}
double volumeOf(const MeshShape& mesh) { return mesh.mesh->volume(); }
double volumeOf(const SphereShape& sphere) { return 4.0 / 3.0 * std::numbers::pi * std::pow(sphere.radius, 3); }

SurfacePoint surfaceAt(const BoxShape& box, const Double3& local) {
  const Double3 half = halfExtents(box);
  Double3 beyond, outside;
  size_t nearest = 0;
  for (size_t a = 0; a < 3; ++a) {
    beyond[a] = std::abs(local[a]) - half[a];
    outside[a] = std::max(beyond[a], 0.0);
    if (beyond[a] > beyond[nearest]) nearest = a;
  }
  SurfacePoint point;
  const double far = std::sqrt(dot(outside, outside));
  const auto side = [&](size_t a) { return local[a] < 0 ? -1.0 : 1.0; };
  point.distance = far > 0 ? far : beyond[nearest];
  for (size_t a = 0; a < 3; ++a) point.normal[a] = far > 0 ? side(a) * outside[a] / far : (a == nearest ? side(a) : 0);
  return point;
}

SurfacePoint surfaceAt(const SphereShape& sphere, const Double3& local) {
  SurfacePoint point;
  const double r = std::sqrt(dot(local, local));
  point.distance = r - sphere.radius;
  if (r > 0)
    for (size_t a = 0; a < 3; ++a) point.normal[a] = local[a] / r;
  return point;
}

SurfacePoint surfaceAt(const MeshShape& mesh, const Double3& local) {
  const MeshImpl& impl = implOf(*mesh.mesh);
  const NearestPoint nearest = impl.tree.nearest(local);
  const double distance = std::sqrt(nearest.squared), sign = !impl.twoSided && impl.tree.winding(local) != 0 ? -1 : 1;
  SurfacePoint point{.distance = sign * distance};
  if (distance > 0)
    for (size_t a = 0; a < 3; ++a) point.normal[a] = sign * (local[a] - nearest.point[a]) / distance;
  return point;
}

std::array<double, 2> boxInterval(const Double3& low, const Double3& high, const Double3& from, const Double3& along) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double first = -kInfinity, last = kInfinity;
  for (size_t a = 0; a < 3; ++a) {
    if (along[a] == 0) {
      if (from[a] < low[a] || from[a] > high[a]) return {kInfinity, -kInfinity};
      continue;
    }
    const double one = (low[a] - from[a]) / along[a], other = (high[a] - from[a]) / along[a];
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return {first, last};
}

std::optional<double> rayEntry(const BoxShape& box, const Double3& from, const Double3& along) {
  const Double3 half = halfExtents(box);
  const auto [first, last] = boxInterval({-half[0], -half[1], -half[2]}, half, from, along);
  return first <= last ? ifAhead(first) : std::nullopt;
}

std::optional<double> rayEntry(const SphereShape& sphere, const Double3& from, const Double3& along) {
  const double nearest = -dot(from, along), across = dot(from, from) - nearest * nearest, square = sphere.radius * sphere.radius;
  return across > square ? std::nullopt : ifAhead(nearest - std::sqrt(square - across));
}

std::optional<double> rayEntry(const MeshShape& mesh, const Double3& from, const Double3& along) {
  const MeshImpl& impl = implOf(*mesh.mesh);
  if (!impl.twoSided && impl.tree.winding(from) != 0) return std::nullopt;
  return impl.tree.firstHit(from, along);
}

void translate(Solid& solid, const Double3& by) {
  for (size_t a = 0; a < 3; ++a) solid.translation[a] += by[a];
}

Double3 centerOf(const Shape& shape) {
  return std::visit([](const auto& s) { return centerOf(s); }, shape);
}
Double3 centerOf(const Solid& solid) {
  Double3 center = centerOf(solid.shape);
  for (size_t a = 0; a < 3; ++a) center[a] += solid.translation[a];
  return center;
}
Double3 halfExtents(const Shape& shape) {
  return std::visit([](const auto& s) { return halfExtents(s); }, shape);
}
double boundingRadius(const Shape& shape) {
  return std::visit([](const auto& s) { return boundingRadius(s); }, shape);
}
SurfacePoint surfaceAt(const Shape& shape, const Double3& local) {
  return std::visit([&](const auto& s) { return surfaceAt(s, local); }, shape);
}
std::optional<double> rayEntry(const Shape& shape, const Double3& from, const Double3& along) {
  return std::visit([&](const auto& s) { return rayEntry(s, from, along); }, shape);
}

}  // namespace rill
