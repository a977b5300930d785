#include "bench/suites/tank.hpp"

#include <algorithm>
#include <cmath>

#include "core/words.hpp"

namespace rill::bench {

Expected<Scene> tank(uint32_t count, std::vector<Override> changes) {
  // The box is 2.5 x 2.5 x 1 m: an even number of layers along z gives integers along x and y.
  const double layers = 2 * std::max(1.0, std::round(std::cbrt(count / 6.25) / 2));
  changes.push_back({"fluid.spacing", shortestNumber(1 / layers)});
  return namedScene("dam50k", changes);
}

}  // namespace rill::bench
