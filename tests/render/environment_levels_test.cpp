// Coarser levels of environment maps.
#include <gtest/gtest.h>

#include <vector>

#include "render/environment_mips.hpp"
#include "render/environment_pictures.hpp"

namespace rill::test {
namespace environment_test {

Rgb meanOf(const uint32_t* texels, uint32_t rows) {
  Rgb sum{};
  for (uint32_t y = 0; y < rows; ++y)
    for (uint32_t x = 0; x < 2 * rows; ++x) {
      const Rgb color = unpacked(texels[y * 2 * rows + x]);
      for (size_t c = 0; c < 3; ++c) sum[c] += color[c] * solidAngle(y, 2 * rows) / (4 * std::numbers::pi);
    }
  return sum;
}

// The tolerance is that of nine bits per component, of texels and of their means.
TEST(EnvironmentLevels, KeepTheMeanOfAnySize) {
  for (const uint32_t width : {2u, 4u, 12u, 64u, 146u, 500u}) {
    uint32_t state = 7;
    const auto random = [&] { return double((state = state * 1664525 + 1013904223) >> 8) / (1 << 24); };
    const EnvironmentPicture map = picture(width, [&](uint32_t, uint32_t) { return Rgb{random(), 20 * random() * random(), 0.5}; });
    const auto levels = environmentLevels(map);
    const Rgb wanted = meanOf(map.texels.data(), map.height);
    size_t first = 0;
    for (uint32_t rows = map.height;; rows /= 2) {
      ASSERT_LE(first + 2 * rows * rows, levels.size()) << width;
      const Rgb mean = meanOf(&levels[first], rows);
      for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], wanted[c], 0.004 * wanted[c] + 20.0 / 1024) << width << ", " << rows << " rows";
      first += 2 * rows * rows;
      if (rows == 1) break;
    }
    EXPECT_EQ(first, levels.size());
  }
}

TEST(EnvironmentLevels, FinestAreLeftOutWhereABufferIsTooSmall) {
  const EnvironmentPicture map = picture(16, [](uint32_t x, uint32_t y) { return Rgb{double(x), double(y), 1}; });
  const auto whole = environmentLevels(map);  // 128 + 32 + 8 + 2 texels
  ASSERT_EQ(whole.size(), 170u);
  auto levels = whole;
  EXPECT_EQ(dropFineLevels(levels, 8, 680), 8u);
  EXPECT_EQ(levels, whole);
  EXPECT_EQ(dropFineLevels(levels, 8, 679), 4u);
  EXPECT_EQ(levels, std::vector(whole.begin() + 128, whole.end()));
  EXPECT_EQ(dropFineLevels(levels, 4, 39), 1u);
  EXPECT_EQ(levels.size(), 2u);
}

}  // namespace environment_test
}  // namespace rill::test
