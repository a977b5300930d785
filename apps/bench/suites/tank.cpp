#include "bench/suites/tank.hpp"

#include <algorithm>
#include <cmath>

#include "core/words.hpp"

namespace rill::bench {
namespace {

constexpr double kVolume_m3 = 2.5 * 2.5 * 1;  // of the fluid at the start

}  // namespace

Expected<Scene> tank(uint32_t count, std::vector<Override> changes) {
  // The box is 2.5 x 2.5 x 1 m: an even number of layers along z gives integers along x and y.
  const double layers = 2 * std::max(1.0, std::round(std::cbrt(count / kVolume_m3) / 2));
  changes.push_back({"fluid.spacing", shortestNumber(1 / layers)});
  return namedScene("dam50k", changes);
}

uint64_t tankParticles(const Scene& scene) {
  const double layers = 1 / scene.fluid.spacing;
  return static_cast<uint64_t>(std::llround(kVolume_m3 * layers * layers * layers));
}

}  // namespace rill::bench
