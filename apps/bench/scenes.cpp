#include "bench/scenes.hpp"

#include <algorithm>

namespace rill::bench {

Scene boxScene(double spacing_m, const Double3& min, const Double3& max) {
  Scene scene;
  scene.name = "bench";
  scene.fluid.spacing = spacing_m;
  scene.domain.emplace();
  scene.domain->min = min;
  scene.domain->max = max;
  return scene;
}

Fill boxFill(const Double3& min, const Double3& max) {
  Fill fill;
  fill.shape = BoxShape{min, max};
  return fill;
}

}  // namespace rill::bench
