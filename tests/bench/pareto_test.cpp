#include "bench/pareto.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/trajectory.hpp"

namespace rill::bench {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Pareto, ReturnsFrontByIncreasingCost) {
  const std::vector<CostError> points{{3, 1}, {1, 4}, {2, 4}, {2, 2}, {4, 1}, {1, 5}, {0.5, kNan}, {kNan, 0.1}};
  EXPECT_EQ(paretoFront(points), (std::vector<size_t>{1, 3, 0})) << "by increasing cost; of equal points only the first";
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(Pareto, InterpolatesCostInLogLogSpace) {
  const std::vector<CostError> points{{1, 1e-2}, {10, 1e-4}};
  EXPECT_NEAR(costAtError(points, 1e-3), std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(costAtError(points, 1e-2), 1, 1e-12);
  EXPECT_NEAR(costAtError(points, 1e-4), 10, 1e-12);
  EXPECT_TRUE(std::isnan(costAtError(points, 1e-5)));
  EXPECT_TRUE(std::isnan(costAtError(points, 1e-1)));
}

apps::Instant instant(double x, double kinetic) {
  apps::Instant instant;
  instant.stats.centerOfMass[0] = x;
  instant.stats.kinetic_J = kinetic;
  return instant;
}

TEST(Trajectory, DistanceIsDimensionlessRootMeanSquare) {
  const std::vector<apps::Instant> a{instant(1, 10), instant(2, 20)}, b{instant(1, 10), instant(5, 20)};
  const Trajectory left = trajectoryOf(a, 2, 10), right = trajectoryOf(b, 2, 10);
  EXPECT_EQ(rmsDistance(left, left), 0);
  EXPECT_NEAR(rmsDistance(left, right), 1.5 / std::sqrt(2.0 * Trajectory::kQuantities), 1e-12)
      << "3 m over a length of 2 m, once in twelve";
  const std::vector<Trajectory> both{left, right};
  EXPECT_NEAR(rmsDistance(meanTrajectory(both), left), rmsDistance(meanTrajectory(both), right), 1e-12);
}

TEST(Trajectory, DistanceOfNaNOrEmptyIsInfinite) {
  const std::vector<apps::Instant> good{instant(1, 10)}, bad{instant(kNan, 10)};
  EXPECT_TRUE(std::isinf(rmsDistance(trajectoryOf(good, 1, 1), trajectoryOf(bad, 1, 1))));
  EXPECT_TRUE(std::isinf(rmsDistance(trajectoryOf(good, 1, 1), Trajectory{})));
}

}  // namespace
}  // namespace rill::bench
