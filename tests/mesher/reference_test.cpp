// The reference of the mesher's field against what it promises.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/surface_mesh.hpp"

namespace rill::test {
namespace {

/// Integral of the kernel over a plane at this distance from its center.
double overPlane(double z) {
  constexpr double kStep = 1e-4;
  double sum = 0;
  for (double r = kStep / 2; r < 1.5; r += kStep) sum += 2 * std::numbers::pi * r * reference::meshKernel(std::sqrt(r * r + z * z)) * kStep;
  return sum;
}

TEST(MeshReference, KernelSumsToQuadraticSplineOverPlanes) {
  for (double z = 0; z < 1.6; z += 0.05) {
    const double spline = z < 0.5 ? 0.75 - z * z : z < 1.5 ? 0.5 * (1.5 - z) * (1.5 - z) : 0;
    EXPECT_NEAR(overPlane(z), spline, 1e-3) << z;
  }
}

TEST(MeshReference, KernelSlopeIsItsDerivative) {
  for (double r = 0.05; r < 1.8; r += 0.1)
    EXPECT_NEAR(reference::meshKernelSlope(r), (reference::meshKernel(r + 1e-6) - reference::meshKernel(r - 1e-6)) / 2e-6, 1e-5) << r;
}

TEST(MeshReference, DistanceToPlaneIsExact) {
  for (double z = -0.95; z < 0.95; z += 0.1) {  // above the surface; the layers lie at -1/2, -3/2, ...
    double sum = 0;
    for (int layer = 0; layer < 4; ++layer) sum += overPlane(std::abs(z + 0.5 + layer));
    EXPECT_NEAR(reference::meshDistance(sum), z, 2e-3);
  }
}

TEST(MeshReference, EllipsoidsOfAPlaneAreFlat) {
  std::vector<glm::dvec3> points;
  for (int i = -4; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      for (int k = -4; k <= 4; ++k) points.push_back({i, -j, k});
  const auto all = reference::ellipsoids(points);
  const auto& top = all[size_t(4 * 45 + 4)];  // in the middle of the upper layer
  ASSERT_EQ(top.center, glm::dvec3(0));
  EXPECT_TRUE(top.surface);
  EXPECT_NEAR(top.toKernel[1][1], 1, 1e-9);
  EXPECT_LT(top.toKernel[0][0], 0.6);
  EXPECT_LT(top.toKernel[2][2], 0.6);
  const auto& deep = all[size_t(4 * 45 + 2 * 9 + 4)];
  EXPECT_FALSE(deep.surface);
}

}  // namespace
}  // namespace rill::test
