#pragma once
#include <array>

#include "views/camera.hpp"

namespace rill::view {

/// Where gravity is tilted to, as one sees it in the picture.
enum class Tilt { Left, Right, Away, Towards };

/// Gravity turned by `degrees` over the horizontal direction of the picture, as long as before. Turned as far as it goes, it lies
/// along it. No gravity stays none.
std::array<double, 3> tilted(const std::array<double, 3>& gravity, const CameraView& eye, Tilt tilt, double degrees);

}  // namespace rill::view
