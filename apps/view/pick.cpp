#include "view/pick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rill::view {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// `center`: of the sphere, relative to the ray's origin.
std::optional<double> hitSphere(const Vector& center, const Vector& along, double radius) {
  const double nearest = dot(center, along), across = dot(center, center) - nearest * nearest;
  if (across > radius * radius) return std::nullopt;
  const double distance = nearest - std::sqrt(radius * radius - across);
  return distance > 0 ? std::optional(distance) : std::nullopt;
}

std::optional<double> hitSolid(const Ray& ray, const SolidPose& solid) {
  if (solid.sphere) {
    Vector center;
    for (size_t a = 0; a < 3; ++a) center[a] = solid.center[a] - ray.from[a];
    return hitSphere(center, ray.along, solid.half[0]);
  }
  Ray local;
  Vector end;
  const Vector ahead = ray.at(1);
  toSolid(solid, ray.from.data(), local.from.data());
  toSolid(solid, ahead.data(), end.data());
  for (size_t a = 0; a < 3; ++a) local.along[a] = end[a] - local.from[a];
  const auto distance = entry(local, {-solid.half[0], -solid.half[1], -solid.half[2]}, {solid.half[0], solid.half[1], solid.half[2]});
  return distance && *distance > 0 ? distance : std::nullopt;
}

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

std::optional<Picked> pick(const Ray& ray, std::span<const Float3> positions, const double origin[3], double radius,
                           std::span<const SolidPose> solids) {
  std::optional<Picked> first;
  const auto take = [&](std::optional<double> distance, std::optional<uint32_t> solid) {
    if (distance && (!first || *distance < first->distance)) first = Picked{*distance, solid};
  };
  for (const Float3& p : positions)
    take(hitSphere({p.x + origin[0] - ray.from[0], p.y + origin[1] - ray.from[1], p.z + origin[2] - ray.from[2]}, ray.along, radius), {});
  for (uint32_t k = 0; k < solids.size(); ++k) take(hitSolid(ray, solids[k]), k);
  return first;
}

std::optional<double> entry(const Ray& ray, const Vector& low, const Vector& high) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (size_t a = 0; a < 3; ++a) {
    if (ray.along[a] == 0) {
      if (ray.from[a] < low[a] || ray.from[a] > high[a]) return std::nullopt;
      continue;
    }
    const double one = (low[a] - ray.from[a]) / ray.along[a], other = (high[a] - ray.from[a]) / ray.along[a];
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first <= last ? std::optional(first) : std::nullopt;
}

std::optional<double> hitPlane(const Ray& ray, const Vector& point, const Vector& normal) {
  const Vector offset{point[0] - ray.from[0], point[1] - ray.from[1], point[2] - ray.from[2]};
  const double distance = dot(offset, normal) / dot(ray.along, normal);
  return std::isfinite(distance) && distance > 0 ? std::optional(distance) : std::nullopt;
}

}  // namespace rill::view
