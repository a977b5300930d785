#pragma once
#include <glm/vec3.hpp>
#include <random>
#include <vector>

namespace rill::test {

/// Points spread evenly over a cube with an edge of `edge`, whose lowest corner is `from`.
inline std::vector<glm::dvec3> randomCloud(size_t count, double edge, unsigned seed, glm::dvec3 from = glm::dvec3(0)) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, edge);
  std::vector<glm::dvec3> x(count);
  for (glm::dvec3& p : x)
    for (int a = 0; a < 3; ++a) p[a] = from[a] + place(random);
  return x;
}

}  // namespace rill::test
