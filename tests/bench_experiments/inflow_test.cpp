#include "bench/experiments/inflow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

namespace rill::bench {
namespace {

TEST(SlabMeans, DepthOfLatticeIsItsHeight) {
  constexpr double kCell = 0.1;
  Cloud cloud;
  cloud.spacing = kCell;
  for (int i = 0; i < 10; ++i)
    for (int j = -2; j < 7; ++j) {
      cloud.position.push_back({(i + 0.5) * kCell, 2 + (j + 0.5) * kCell, 0});
      cloud.velocity.push_back({i < 5 ? 1.0 : 3.0, double(j), 0});
    }
  const SlabMeans half = slabMeans(cloud, 0.5, 1, 2);
  EXPECT_EQ(half.particles, 5 * 7);
  EXPECT_NEAR(half.depth(), 0.7, 1e-12);
  EXPECT_NEAR(half.velocity_m_s.x, 3, 1e-12);
  EXPECT_NEAR(half.velocity_m_s.y, 3, 1e-12) << "without those below the floor";
  EXPECT_TRUE(std::isnan(slabMeans(cloud, 5, 6, 2).depth()));
}

TEST(TimeMean, IsNotANumberWithoutInstants) {
  TimeMean mean;
  EXPECT_TRUE(std::isnan(mean.value()));
  mean.add(1), mean.add(4);
  EXPECT_EQ(mean.value(), 2.5);
}

TEST(InflowAlongX, FillsItsRectangle) {
  const Emitter emitter = inflowAlongX(0.1, 0.2, 0.5, 0.8, 2);
  const auto& mouth = std::get<RectMouth>(emitter.mouth);
  EXPECT_NEAR(mouth.center.y, 0.35, 1e-12);
  EXPECT_NEAR(mouth.center.z, 0.4, 1e-12);
  EXPECT_NEAR(mouth.size.first, 0.8, 1e-12);
  EXPECT_NEAR(mouth.size.second, 0.3, 1e-12);
  EXPECT_EQ(emitter.speed, 2);
}

}  // namespace
}  // namespace rill::bench
