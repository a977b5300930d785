#include "view/pick.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill::view {
namespace {

using Vector = Double3;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

Ray rayThrough(const CameraView& eye, double right, double down) {
  const CameraBasis basis = cameraBasis(eye);
  const double spread = 2 * std::tan(eye.fov_y_deg * std::numbers::pi / 360);
  Ray ray;
  for (size_t a = 0; a < 3; ++a) {
    ray.from[a] = eye.eye[a];
    ray.along[a] = basis.forward[a] + spread * (right * basis.right[a] - down * basis.up[a]);
  }
  const double length = std::sqrt(dot(ray.along, ray.along));
  for (double& a : ray.along) a /= length;
  return ray;
}

std::optional<std::array<double, 2>> imagePlace(const CameraView& eye, const Double3& point) {
  const CameraBasis basis = cameraBasis(eye);
  const Vector offset{point[0] - eye.eye[0], point[1] - eye.eye[1], point[2] - eye.eye[2]};
  const double depth = dot(offset, basis.forward), spread = 2 * std::tan(eye.fov_y_deg * std::numbers::pi / 360) * depth;
  if (!(spread > 0)) return std::nullopt;
  return std::array{dot(offset, basis.right) / spread, -dot(offset, basis.up) / spread};
}

std::optional<Picked> pick(const Ray& ray, std::span<const Float3> positions, const Double3& origin, double radius,
                           std::span<const Solid> solids, std::span<const Pose> poses) {
  std::optional<Picked> first;
  const auto take = [&](std::optional<double> distance, std::optional<uint32_t> solid) {
    if (distance && (!first || *distance < first->distance)) first = Picked{*distance, solid};
  };
  const SphereShape ball{.radius = radius};
  for (const Float3& p : positions)
    take(rayEntry(ball, {ray.from[0] - p.x - origin[0], ray.from[1] - p.y - origin[1], ray.from[2] - p.z - origin[2]}, ray.along), {});
  for (uint32_t k = 0; k < poses.size(); ++k)
    take(rayEntry(solids[k].shape, localPoint(poses[k], ray.from), toSolid(poses[k], ray.along)), k);
  return first;
}

std::optional<double> entry(const Ray& ray, const Vector& low, const Vector& high) {
  const auto [first, last] = boxInterval(low, high, ray.from, ray.along);
  return first <= last && last >= 0 ? std::optional(std::max(first, 0.0)) : std::nullopt;
}

std::optional<double> hitPlane(const Ray& ray, const Vector& point, const Vector& normal) {
  const Vector offset{point[0] - ray.from[0], point[1] - ray.from[1], point[2] - ray.from[2]};
  const double distance = dot(offset, normal) / dot(ray.along, normal);
  return std::isfinite(distance) && distance > 0 ? std::optional(distance) : std::nullopt;
}

}  // namespace rill::view
