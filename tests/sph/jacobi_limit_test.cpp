#include "sph/jacobi_limit.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace rill {
namespace {

/// Growth factor of the dominant compression wave per Jacobi iteration (linear, unclamped) on a periodic lattice of n^3, by power
/// iteration.
double growth(const SmoothingKernel& kernel, double omega, int n) {
  const double d = kernel.spacing();
  const int reach = static_cast<int>(kernel.h() / d + 1);
  std::vector<glm::ivec3> offsets;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k)
        if (const double r = glm::length(glm::dvec3(i, j, k)) * d; r > 0 && r < kernel.h()) offsets.emplace_back(i, j, k);
  const auto index = [n](glm::ivec3 p) { return static_cast<size_t>(((p.z + n) % n * n + (p.y + n) % n) * n + (p.x + n) % n); };
  const auto gradient = [&](glm::ivec3 o) { return kernel.gradientOverR(glm::length(glm::dvec3(o)) * d) * d * glm::dvec3(o); };
  std::vector<double> c(static_cast<size_t>(n * n * n));
  unsigned seed = 7;
  for (double& value : c) value = double((seed = seed * 1664525u + 1013904223u) >> 8) / (1 << 24) - 0.5;
  double factor = 0;
  std::vector<glm::dvec3> move(c.size());
  for (int round = 0; round < 120; ++round) {
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          glm::dvec3 sum(0);
          // offsets point from the neighbor here: grad_i K(x_i - x_j)
          for (const glm::ivec3& o : offsets) sum += (c[index({x, y, z})] + c[index(glm::ivec3(x, y, z) - o)]) * gradient(o);
          move[index({x, y, z})] = -omega / kernel.restGradientSum() * sum;
        }
    double before = 0, after = 0;
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          double change = 0;
          for (const glm::ivec3& o : offsets)
            change += glm::dot(gradient(o), move[index({x, y, z})] - move[index(glm::ivec3(x, y, z) - o)]);
          double& value = c[index({x, y, z})];
          before += value * value;
          value += change;
          after += value * value;
        }
    factor = std::sqrt(after / before);
    for (double& value : c) value /= std::sqrt(after);
  }
  return factor;
}

TEST(JacobiLimit, SeparatesConvergenceFromDivergence) {
  for (const double ratio : {1.5, 2.0, 2.5}) {
    const SmoothingKernel kernel(KernelChoice::Wendland, ratio * 0.1, 0.1);
    const double limit = maxJacobiRelaxation(kernel);
    EXPECT_LE(growth(kernel, 0.98 * limit, 12), 1.0) << ratio;
    EXPECT_GT(growth(kernel, 1.05 * limit, 12), 1.0) << ratio;
  }
}

TEST(JacobiLimit, IsScaleInvariant) {
  for (const KernelChoice choice : {KernelChoice::Wendland, KernelChoice::Poly6Spiky})
    EXPECT_NEAR(maxJacobiRelaxation({choice, 2e-4, 1e-4}), maxJacobiRelaxation({choice, 200, 100}), 1e-6);
}

}  // namespace
}  // namespace rill
