#include "bench/experiments/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rill::bench {
namespace {

constexpr double kSpacing = 0.05;

/// A block of the rest lattice with its minimum corner at the origin.
Cloud lattice(int x, int y, int z, double stretch = 1) {
  Cloud cloud;
  cloud.spacing = kSpacing;
  for (int i = 0; i < x; ++i)
    for (int j = 0; j < y; ++j)
      for (int k = 0; k < z; ++k) {
        cloud.position.push_back({(i + 0.5) * kSpacing * stretch, (j + 0.5) * kSpacing * stretch, (k + 0.5) * kSpacing * stretch});
        cloud.velocity.push_back({0, 0, 0});
      }
  return cloud;
}

Walls noWalls() { return {}; }

TEST(NeighborGrid, MatchesBruteForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  std::vector<Double3> points;
  for (int i = 0; i < 500; ++i) points.push_back({anywhere(random), anywhere(random), anywhere(random)});
  const NeighborGrid grid(points, 0.3);
  for (const Double3& center : points) {
    size_t found = 0, expected = 0;
    grid.within(center, 0.3, [&](size_t, double) { ++found; });
    for (const Double3& other : points)
      if (std::hypot(other[0] - center[0], other[1] - center[1], other[2] - center[2]) <= 0.3) ++expected;
    EXPECT_EQ(found, expected);
  }
}

TEST(Measures, RestLatticeHasRestDensity) {
  const BulkDensity bulk = bulkDensity(lattice(12, 12, 12), noWalls(), 2 * kSpacing);
  ASSERT_GT(bulk.particles, 0u);
  EXPECT_NEAR(bulk.error, 0, 1e-9);
}

TEST(Measures, StretchedLatticeHasMatchingDensityError) {
  for (const double stretch : {1.01, 0.99}) {
    const BulkDensity bulk = bulkDensity(lattice(14, 14, 14, stretch), noWalls(), 2 * kSpacing);
    ASSERT_GT(bulk.particles, 0u);
    EXPECT_NEAR(bulk.error, std::pow(stretch, -3) - 1, 0.002);
  }
}

TEST(Measures, InteriorExcludesSurfaceAndWalls) {
  const Cloud cloud = lattice(12, 12, 12);
  for (const size_t i : interiorParticles(cloud, noWalls(), 4 * kSpacing))
    for (const double coordinate : cloud.position[i]) {
      EXPECT_GT(coordinate, 3 * kSpacing);
      EXPECT_LT(coordinate, 9 * kSpacing);
    }
  Walls walls;
  walls.min = {0, 0, 0};
  walls.max = {0.6, 0.6, 0.6};
  walls.closed = 63;
  EXPECT_EQ(interiorParticles(cloud, walls, 4 * kSpacing).size(), 64u);  // 4 of 12 per axis are 4 spacings from both walls
  EXPECT_TRUE(interiorParticles(lattice(4, 4, 4), noWalls(), 4 * kSpacing).empty());
}

TEST(Measures, CountsClumpedParticles) {
  Cloud cloud = lattice(10, 10, 10);
  EXPECT_EQ(clumpedFraction(cloud), 0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-0.2 * kSpacing, 0.2 * kSpacing);
  for (Double3& point : cloud.position)
    for (double& coordinate : point) coordinate += jitter(random);
  EXPECT_EQ(clumpedFraction(cloud), 0);  // jitter of 0.2 leaves at least 0.6 spacings
  cloud.position[0] = cloud.position[500];
  cloud.position[0][0] += 0.3 * kSpacing;
  EXPECT_NEAR(clumpedFraction(cloud), 2.0 / 1000, 1e-12);
}

TEST(Measures, LevelOfBlockIsItsHeight) {
  EXPECT_NEAR(surfaceLevel(lattice(8, 11, 6), 0, 0, 1), 11 * kSpacing, 1e-12);
  EXPECT_NEAR(surfaceLevel(lattice(8, 11, 6), -1, 0, 1), 1 + 11 * kSpacing, 1e-12);
}

TEST(Measures, LevelIgnoresVoids) {
  Cloud cloud = lattice(9, 12, 9);
  std::erase_if(cloud.position, [](const Double3& p) { return std::hypot(p[0] - 0.225, p[1] - 0.2, p[2] - 0.225) < 0.1; });
  EXPECT_NEAR(surfaceLevel(cloud, 0, 0, 1), 12 * kSpacing, 1e-12);
}

TEST(Measures, FrontIgnoresIsolatedParticles) {
  Cloud cloud = lattice(10, 6, 6);
  EXPECT_NEAR(frontAlongX(cloud), 10 * kSpacing, 1e-12);
  cloud.position.push_back({3, 0.1, 0.1});
  EXPECT_NEAR(frontAlongX(cloud), 10 * kSpacing, 1e-12);
}

TEST(Measures, HeightAtWallEndsAtFirstGap) {
  Cloud cloud = lattice(6, 9, 4);
  EXPECT_NEAR(heightAtWall(cloud, 0, 0), 9 * kSpacing, 1e-12);
  cloud.position.push_back({0.02, 1, 0.1});  // a detached particle
  EXPECT_NEAR(heightAtWall(cloud, 0, 0), 9 * kSpacing, 1e-12);
}

TEST(Measures, AngularMomentumExcludesTranslation) {
  Cloud cloud = lattice(6, 6, 6);
  const Double3 center = meanPosition(cloud);
  double moment = 0;
  for (size_t i = 0; i < cloud.size(); ++i) {
    const double x = cloud.position[i][0] - center[0], y = cloud.position[i][1] - center[1];
    cloud.velocity[i] = {5 - 2 * y, 2 * x, 1};
    moment += (x * x + y * y) / double(cloud.size());
  }
  const Double3 angularMomentum = meanAngularMomentum(cloud);
  EXPECT_NEAR(angularMomentum[0], 0, 1e-12);
  EXPECT_NEAR(angularMomentum[1], 0, 1e-12);
  EXPECT_NEAR(angularMomentum[2], 2 * moment, 1e-12);
  EXPECT_NEAR(meanVelocity(cloud)[0], 5, 1e-12);
  EXPECT_GT(rmsSpeed(cloud), 5);
}

}  // namespace
}  // namespace rill::bench
