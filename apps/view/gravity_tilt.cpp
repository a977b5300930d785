#include "view/gravity_tilt.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rill::view {

Double3 tilted(const Double3& gravity, const CameraView& eye, Tilt tilt, double degrees) {
  const double length = std::hypot(gravity[0], gravity[1], gravity[2]);
  if (!(length > 0)) return gravity;
  const CameraBasis basis = cameraBasis(eye);
  // Horizontal directions to the right of the image and away from the camera.
  const double rightLength = std::hypot(basis.right[0], basis.right[2]);
  const double right[2] = {basis.right[0] / rightLength, basis.right[2] / rightLength};
  const double away[2] = {right[1], -right[0]};
  const double sign = tilt == Tilt::Left || tilt == Tilt::Towards ? -1 : 1;
  const auto& horizontal = tilt == Tilt::Left || tilt == Tilt::Right ? right : away;
  const Double3 direction{sign * horizontal[0], 0, sign * horizontal[1]};

  double along = 0;
  for (size_t a = 0; a < 3; ++a) along += gravity[a] / length * direction[a];
  const double angle = std::acos(std::clamp(along, -1.0, 1.0)), step = std::min(degrees * std::numbers::pi / 180, angle);
  if (angle < 1e-9) return gravity;
  Double3 across{};  // the part of the direction perpendicular to gravity
  double size = 0;
  for (size_t a = 0; a < 3; ++a) {
    across[a] = direction[a] - along * gravity[a] / length;
    size += across[a] * across[a];
  }
  if (size < 1e-18) return gravity;  // antiparallel: no plane of rotation
  Double3 turned{};
  for (size_t a = 0; a < 3; ++a) {
    turned[a] = std::cos(step) * gravity[a] + std::sin(step) * length * across[a] / std::sqrt(size);
    if (std::abs(turned[a]) < 1e-6 * length) turned[a] = 0;  // remove rounding errors
  }
  return turned;
}

}  // namespace rill::view
