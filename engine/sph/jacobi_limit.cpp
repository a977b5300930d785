#include "sph/jacobi_limit.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

namespace rill {

double maxJacobiRelaxation(const SmoothingKernel& kernel) {
  struct Neighbor {
    glm::dvec3 at, correction, response;  // gradients for corrections and for the density change; they differ for poly6 with spiky
  };
  std::vector<Neighbor> neighbors;
  const double h = kernel.h(), d = kernel.spacing();
  const int reach = static_cast<int>(std::ceil(h / d));
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const glm::dvec3 at = glm::dvec3(i, j, k) * d;
        const double r = glm::length(at), step = 1e-5 * h;
        if (r == 0 || r >= h) continue;
        const double slope = (kernel.value(r + step) - kernel.value(r - step)) / (2 * step);
        neighbors.push_back({at, kernel.gradientOverR(r) * at, slope / r * at});
      }
  // By symmetry, a sixth of an octant covers all wave vectors.
  constexpr int kNodes = 12;
  double largest = 0;
  for (int a = 0; a <= kNodes; ++a)
    for (int b = 0; b <= a; ++b)
      for (int c = 0; c <= b; ++c) {
        const glm::dvec3 wave = glm::dvec3(a, b, c) * (std::numbers::pi / (kNodes * d));
        glm::dvec3 correction(0), response(0);
        for (const Neighbor& n : neighbors) {
          const double phase = std::sin(glm::dot(wave, n.at));
          correction += phase * n.correction;
          response += phase * n.response;
        }
        largest = std::max(largest, glm::dot(correction, response));
      }
  return largest > 0 ? 2 * kernel.restGradientSum() / largest : 2;
}

}  // namespace rill
