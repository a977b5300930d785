#pragma once
#include <array>

#include "rill/scene.hpp"

namespace rill::bench {

using Point = std::array<double, 3>;

/// A scene with default settings in a closed box, m.
Scene boxScene(double spacing_m, const Point& min, const Point& max);
Fill boxFill(const Point& min, const Point& max);

}  // namespace rill::bench
