// Which particles are active, finite and drawn, also where a device assumes that there are no NaNs and infinities.
#include <cmath>
#include <limits>

#include "shared/fluid_records.h"
#include "support/gpu_test.hpp"

namespace rill::test {
namespace active_test {

TEST_F(GpuTest, ActiveParticlesAreFoundByBits) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
  const float below = std::nextafter(kInactiveLimit, 0.0f);
  const std::vector<float> numbers = {0,
                                      1,
                                      -4.9f,
                                      5,
                                      std::nextafter(5.0f, 0.0f),
                                      -5,
                                      1e-40f,
                                      below,
                                      -below,
                                      kNan,
                                      -kNan,
                                      kInactiveLimit,
                                      1e9f,
                                      -kInactiveLimit,
                                      kInfinite,
                                      -kInfinite};
  const auto found = wordsFrom("active", upload("numbers", numbers), numbers.size(), 1);
  ASSERT_EQ(found.size(), numbers.size());
  for (size_t i = 0; i < numbers.size(); ++i) {
    const float x = numbers[i];
    const bool drawn = std::abs(x) < kInactiveLimit;
    const uint32_t wanted = uint32_t(!(x >= kInactiveLimit)) | uint32_t(std::abs(x) < 5) << 1 | uint32_t(drawn) << 2 | uint32_t(drawn) << 3;
    EXPECT_EQ(found[i], wanted) << x;
  }
}

}  // namespace active_test
}  // namespace rill::test
