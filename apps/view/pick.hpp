#pragma once
// What lies under the pointer.
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "rill/float3.hpp"
#include "sph/solid_pose.hpp"
#include "views/camera.hpp"

namespace rill::view {

struct Ray {
  std::array<double, 3> from{}, along{};  ///< m; unit
  std::array<double, 3> at(double distance) const {
    return {from[0] + distance * along[0], from[1] + distance * along[1], from[2] + distance * along[2]};
  }
};

/// From the eye through the place of its picture that is so far right of the middle and below it, in heights of the picture.
Ray rayThrough(const CameraView& eye, double right, double down);

struct Picked {
  double distance = 0;            ///< m along the ray
  std::optional<uint32_t> solid;  ///< none: the fluid
};

/// What the ray meets first: balls of `radius` about the positions (m, relative to `origin`), or a solid (m, scene coordinates).
std::optional<Picked> pick(const Ray& ray, std::span<const Float3> positions, const double origin[3], double radius,
                           std::span<const SolidPose> solids);

/// Where the ray enters a box, m along it; 0 from inside. None where it misses.
std::optional<double> entry(const Ray& ray, const std::array<double, 3>& low, const std::array<double, 3>& high);

/// Where the ray meets the plane through `point` square to `normal`, m along it; none where that lies behind or nowhere.
std::optional<double> meetsPlane(const Ray& ray, const std::array<double, 3>& point, const std::array<double, 3>& normal);

}  // namespace rill::view
