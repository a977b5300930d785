#include "offline/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace rill::offline {
namespace {

constexpr double kSpacing = 0.1;

Scene tank() {
  Scene scene;
  scene.domain = Domain{{0, 0, 0}, {4, 2, 1}, 0};
  scene.fluid.spacing = kSpacing;
  return scene;
}

/// nx x ny x nz lattice points, as made by a fill at the origin.
std::vector<Float3> block(int nx, int ny, int nz, double x0 = 0, double y0 = 0) {
  std::vector<Float3> points;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        points.push_back({float(x0 + (i + 0.5) * kSpacing), float(y0 + (j + 0.5) * kSpacing), float((k + 0.5) * kSpacing)});
  return points;
}

double front(const Scene& scene, const std::vector<Float3>& points, Axis axis, const Double3& origin = {0, 0, 0}) {
  return ProbeReader(scene, points, origin).front(axis);
}

double level(const Scene& scene, const std::vector<Float3>& points, double x, double z, const Double3& origin = {0, 0, 0}) {
  return ProbeReader(scene, points, origin).level(x, z);
}

TEST(Front, MatchesFillFace) {
  const auto points = block(10, 6, 5);
  EXPECT_NEAR(front(tank(), points, Axis::PlusX), 1.0, 1e-6);
  EXPECT_NEAR(front(tank(), points, Axis::PlusY), 0.6, 1e-6);
  EXPECT_NEAR(front(tank(), points, Axis::PlusZ), 0.5, 1e-6);
  EXPECT_NEAR(front(tank(), points, Axis::MinusX), 0.0, 1e-6);
}

TEST(Front, IgnoresIsolatedParticles) {
  auto points = block(10, 6, 5);
  points.push_back({3.5f, 0.1f, 0.1f});
  EXPECT_NEAR(front(tank(), points, Axis::PlusX), 1.0, 1e-6);
  for (int i = 0; i < 4; ++i) points.push_back({3.5f, 0.1f + 0.01f * float(i + 1), 0.1f});
  EXPECT_NEAR(front(tank(), points, Axis::PlusX), 1.0, 1e-6) << "five particles have four neighbors each";
  points.push_back({3.45f, 0.1f, 0.1f});
  EXPECT_NEAR(front(tank(), points, Axis::PlusX), 3.55, 1e-6);
}

TEST(Front, IsRelativeToDomain) {
  Scene scene = tank();
  scene.domain = Domain{{100, -5, 7}, {104, -3, 8}, 0};
  EXPECT_NEAR(front(scene, block(10, 6, 5), Axis::PlusX, {100, -5, 7}), 1.0, 1e-6);
  EXPECT_NEAR(front(scene, block(10, 6, 5), Axis::PlusX, {101, -5, 7}), 2.0, 1e-6);
  scene.domain.reset();
  EXPECT_NEAR(front(scene, block(10, 6, 5), Axis::PlusX, {2, 0, 0}), 3.0, 1e-6);
}

TEST(Front, IsZeroWithoutFluid) {
  EXPECT_EQ(front(tank(), {}, Axis::PlusX), 0);
  EXPECT_EQ(front(tank(), {{1, 1, 1}}, Axis::PlusX), 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(front(tank(), std::vector<Float3>(9, Float3{nan, nan, nan}), Axis::PlusX), 0);
}

TEST(Level, MatchesColumnHeight) {
  const auto points = block(10, 6, 5);
  EXPECT_NEAR(level(tank(), points, 0.5, 0.25), 0.6, 1e-6);
  EXPECT_EQ(level(tank(), points, 3.0, 0.25), 0) << "no fluid";
  EXPECT_EQ(level(tank(), {}, 0.5, 0.25), 0);
}

TEST(Level, StopsAtTheFirstEmptyBin) {
  auto points = block(10, 3, 5);  // to 0.3
  const auto splash = block(10, 1, 5, 0, 0.8);
  points.insert(points.end(), splash.begin(), splash.end());
  EXPECT_NEAR(level(tank(), points, 0.5, 0.25), 0.3, 1e-6);
  EXPECT_EQ(level(tank(), splash, 0.5, 0.25), 0) << "no fluid on the floor";
}

TEST(Level, UsesParticlesWithinOneSpacing) {
  const std::vector<Float3> points = {{0.5f, 0.05f, 0.25f}, {0.59f, 0.15f, 0.25f}, {0.61f, 0.2f, 0.25f}};
  EXPECT_NEAR(level(tank(), points, 0.5, 0.25), 0.2, 1e-6);
}

TEST(Level, UsesSceneCoordinates) {
  Scene scene = tank();
  scene.domain = Domain{{100, -5, 7}, {104, -3, 8}, 0};
  EXPECT_NEAR(level(scene, block(10, 6, 5), 100.5, 7.25, {100, -5, 7}), 0.6, 1e-6);
}

TEST(NeighborCounter, AgreesWithBruteForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-0.7f, 0.7f);
  std::vector<Float3> points;
  for (int i = 0; i < 400; ++i) points.push_back({anywhere(random), anywhere(random), anywhere(random)});
  points.push_back({std::numeric_limits<float>::infinity(), 0, 0});
  const double radius = 0.2;
  const NeighborCounter counter(points, radius);
  for (uint32_t i = 0; i < points.size(); ++i) {
    uint32_t expected = 0;
    for (uint32_t j = 0; j < points.size(); ++j) {
      const double dx = double(points[j].x) - points[i].x, dy = double(points[j].y) - points[i].y, dz = double(points[j].z) - points[i].z;
      expected += i != j && dx * dx + dy * dy + dz * dz <= radius * radius;
    }
    EXPECT_EQ(counter.count(i), expected) << i;
    EXPECT_EQ(counter.count(i, 3), std::min(expected, 3u));
  }
}

}  // namespace
}  // namespace rill::offline
