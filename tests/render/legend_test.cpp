#include "views/legend.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rill {
namespace {

constexpr uint8_t kGray = 128, kGuard = 77;

/// The picture after drawing, with the guard bytes before and after it checked.
std::vector<uint8_t> draw(uint32_t width, uint32_t height, const LegendDesc& legend) {
  const size_t bytes = size_t{4} * width * height;
  std::vector<uint8_t> memory(bytes + 8192, kGuard);
  std::fill_n(memory.begin() + 4096, bytes, kGray);
  drawLegend({memory.data() + 4096, bytes}, width, height, legend);
  for (size_t k = 0; k < 4096; ++k) {
    EXPECT_EQ(memory[k], kGuard);
    EXPECT_EQ(memory[4096 + bytes + k], kGuard);
  }
  return {memory.begin() + 4096, memory.begin() + 4096 + static_cast<std::ptrdiff_t>(bytes)};
}

TEST(Legend, StaysInsideAnyPicture) {
  for (const uint32_t width : {1u, 16u, 60u, 100u, 161u, 640u}) {
    for (const uint32_t height : {1u, 16u, 40u, 90u, 480u}) {
      for (const double max : {4.0, 0.0, 1e-9, 1e12}) draw(width, height, {ParticleColor::Compression, max, 1234567.5});
    }
  }
}

TEST(Legend, CoversOnlyTheBottomLeftCorner) {
  constexpr uint32_t kWidth = 1280, kHeight = 720;
  const auto picture = draw(kWidth, kHeight, {ParticleColor::Speed, 4, 0.5});
  size_t changed = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const uint8_t* pixel = &picture[4 * (size_t{y} * kWidth + x)];
      if (pixel[0] == kGray && pixel[1] == kGray && pixel[2] == kGray) continue;
      ++changed;
      ASSERT_LT(x, kWidth / 3);
      ASSERT_GT(y, kHeight * 4 / 5);
      EXPECT_EQ(pixel[3], kGray) << "alpha is left as it was";
    }
  }
  EXPECT_GT(changed, 10000u);
}

TEST(Legend, SkipsSmallPictures) {
  for (const uint8_t byte : draw(320, 180, {ParticleColor::Speed, 4, 0.5})) EXPECT_EQ(byte, kGray);
  for (const uint8_t byte : draw(16, 16, {ParticleColor::Speed, 4, 0.5})) EXPECT_EQ(byte, kGray);
}

TEST(Legend, ShowsTheMapFromEndToEnd) {
  constexpr uint32_t kWidth = 640, kHeight = 480;
  const auto picture = draw(kWidth, kHeight, {ParticleColor::Speed, 4, std::nullopt});
  const Float3 first = mapColor(ParticleColor::Speed, 0.002), last = mapColor(ParticleColor::Speed, 0.998);
  bool low = false, high = false;
  for (size_t k = 0; k < picture.size(); k += 4) {
    low = low || (std::abs(picture[k] - srgbByte(first.x)) < 3 && std::abs(picture[k + 2] - srgbByte(first.z)) < 3);
    high = high || (std::abs(picture[k] - srgbByte(last.x)) < 3 && std::abs(picture[k + 1] - srgbByte(last.y)) < 3);
  }
  EXPECT_TRUE(low);
  EXPECT_TRUE(high);
}

}  // namespace
}  // namespace rill
