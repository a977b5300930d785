// The tank that suites run at several sizes.
#include "bench/suites/tank.hpp"

#include <gtest/gtest.h>

#include "rill/particles.hpp"

namespace rill::bench {
namespace {

TEST(Tank, CountsItsParticlesWithoutMakingThem) {
  for (const uint32_t count : {1u, 1000u, 10'000u, 50'000u, 200'000u}) {
    const auto scene = tank(count);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto particles = makeParticles(*scene);
    ASSERT_TRUE(particles) << particles.error().message;
    EXPECT_EQ(tankParticles(*scene), particles->positions.size()) << count;
  }
}

}  // namespace
}  // namespace rill::bench
