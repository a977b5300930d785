#pragma once
// Pictures of the suite "render" and the shapes in them.
#include <memory>
#include <string>
#include <vector>

#include "bench/surface_errors.hpp"
#include "bench/surface_shapes.hpp"

namespace rill::bench {

inline constexpr double kFov = 40;  ///< degrees

struct Picture {
  std::string name;
  Eye eye;
  Jitter jitter = {};
  bool tilted = false;
  bool settings = true;  ///< also measures variants of the settings
};

/// `radius`: pixels of a sphere of 0.75 spacings.
Picture picture(uint32_t width, uint32_t height, double radius);
std::vector<Picture> pictures(bool quick);
std::vector<std::unique_ptr<Shape>> shapesOf(const Picture& picture, bool quick);
/// Shapes of the Pareto fronts: corner and sheets are excluded, since edges dominate their errors.
bool smooth(const Shape& shape);

}  // namespace rill::bench
