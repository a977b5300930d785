#pragma once
// Ray casts for what is under the pointer.
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "rill/vectors.hpp"
#include "shape/pose.hpp"
#include "views/camera.hpp"

namespace rill::view {

struct Ray {
  Double3 from{}, along{};  ///< m; unit vector
  Double3 at(double distance) const {
    return {from[0] + distance * along[0], from[1] + distance * along[1], from[2] + distance * along[2]};
  }
};

/// The ray through a point of the image, `right` and `down` of its center in image heights.
Ray rayThrough(const CameraView& eye, double right, double down);

/// Of a point of the scene (m) in the image, right and down of its center in image heights; nullopt behind the eye.
std::optional<std::array<double, 2>> imagePlace(const CameraView& eye, const Double3& point);

struct Picked {
  double distance = 0;            ///< m along the ray
  std::optional<uint32_t> solid;  ///< none: the fluid
};

/// The first hit of the ray: spheres of `radius` at the positions (m, relative to `origin`), or solids with these poses.
std::optional<Picked> pick(const Ray& ray, std::span<const Float3> positions, const Double3& origin, double radius,
                           std::span<const Solid> solids, std::span<const Pose> poses);

/// Distance at which the ray enters a box, m; 0 from inside; nullopt for a miss.
std::optional<double> entry(const Ray& ray, const Double3& low, const Double3& high);

/// Distance at which the ray hits the plane through `point` with this normal, m; nullopt for a miss.
std::optional<double> hitPlane(const Ray& ray, const Double3& point, const Double3& normal);

}  // namespace rill::view
