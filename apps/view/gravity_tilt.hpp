#pragma once
#include <array>

#include "views/camera.hpp"

namespace rill::view {

/// Direction of a tilt of gravity, as seen in the image.
enum class Tilt { Left, Right, Away, Towards };

/// Gravity rotated by `degrees` towards the horizontal direction `tilt` of the image, at most until it is parallel to it.
/// Its magnitude is kept.
Double3 tilted(const Double3& gravity, const CameraView& eye, Tilt tilt, double degrees);

}  // namespace rill::view
