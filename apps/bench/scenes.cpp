#include "bench/scenes.hpp"

#include <algorithm>

namespace rill::bench {

Scene boxScene(double spacing_m, const Point& min, const Point& max) {
  Scene scene;
  scene.name = "bench";
  scene.fluid.spacing = spacing_m;
  scene.domain.emplace();
  std::ranges::copy(min, scene.domain->min);
  std::ranges::copy(max, scene.domain->max);
  return scene;
}

Fill boxFill(const Point& min, const Point& max) {
  Fill fill;
  auto& box = fill.shape.emplace<BoxShape>();
  std::ranges::copy(min, box.min);
  std::ranges::copy(max, box.max);
  return fill;
}

}  // namespace rill::bench
