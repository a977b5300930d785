#include "reference/emitters.hpp"

#include <algorithm>

namespace rill::reference {

std::vector<Birth> births(const EmitterSettings& e, double t, const glm::dvec3& gravity) {
  std::vector<Birth> all;
  const double end = std::min(t, e.until);
  for (uint64_t layer = 0;; ++layer) {
    const double born = e.from + (static_cast<double>(layer) + 0.5) / e.rate, age = t - born;
    if (born > end) return all;
    for (const glm::dvec3& point : e.points)
      all.push_back({born, point + age * e.velocity + 0.5 * age * age * gravity, e.velocity + age * gravity});
  }
}

}  // namespace rill::reference
