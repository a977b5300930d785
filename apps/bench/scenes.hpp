#pragma once
#include "rill/scene.hpp"

namespace rill::bench {

/// A scene with default settings in a closed box, m.
Scene boxScene(double spacing_m, const Double3& min, const Double3& max);
Fill boxFill(const Double3& min, const Double3& max);

}  // namespace rill::bench
