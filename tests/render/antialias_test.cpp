// Antialiasing of a finished picture: pixels at aliased edges get the edge's coverage, all others stay.
#include <algorithm>
#include <cmath>

#include "support/gpu_test.hpp"
#include "views/finish.hpp"
#include "views/scene_buffers.hpp"

namespace rill::test {
namespace {

using Gray = std::vector<std::vector<double>>;  ///< rows of 0 to 1

class Antialias : public GpuTest {
 protected:
  static constexpr uint32_t kWidth = 53, kHeight = 37;  // not multiples of a workgroup

  static uint32_t packed(double r, double g, double b) {
    const auto byte = [](double v) { return uint32_t(std::lround(v * 255)); };
    return byte(r) | byte(g) << 8 | byte(b) << 16 | 0xFF000000u;
  }
  /// By texel reads and by storage reads, with equal results.
  std::vector<uint32_t> smoothed(const std::vector<uint32_t>& picture, uint32_t width) {
    const uint32_t height = uint32_t(picture.size() / width);
    bringViewShaders(device());
    std::vector<uint32_t> first;
    for (const bool texels : {false, true}) {
      if (texels && device().info().maxTexelBufferElements < picture.size()) continue;
      const auto finish = Finish::create(device(), !texels);
      EXPECT_TRUE(finish) << finish.error().message;
      const Buffer source = upload("picture", picture);
      Graph graph;
      const BufferRef before = graph.import("picture", importOf(source));
      const Ticket ticket = graph.readback(finish->smoothed(graph, before, width, height));
      run(graph);
      auto words = read<uint32_t>(graph, ticket);
      if (!texels)
        first = std::move(words);
      else
        EXPECT_EQ(words, first);
    }
    return first;
  }
  static std::vector<uint32_t> gray(const Gray& rows) {
    std::vector<uint32_t> out;
    for (const auto& row : rows)
      for (const double v : row) out.push_back(packed(v, v, v));
    return out;
  }
};

TEST_F(Antialias, KeepsPixelsWithoutAliasing) {
  Gray flat(kHeight, std::vector<double>(kWidth, 0.4)), ramp = flat, across = flat, down = flat;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) {
      ramp[y][x] = 0.2 + 0.01 * x + 0.004 * y;
      across[y][x] = x < 20 ? 0.1 : 0.8;
      down[y][x] = y < 20 ? 0.9 : 0.2;
    }
  Gray row = flat, column = flat;  // as thin as a pixel
  for (uint32_t x = 0; x < kWidth; ++x) row[9][x] = 0.9;
  for (uint32_t y = 0; y < kHeight; ++y) column[y][30] = 0.9;
  for (const Gray* picture : {&flat, &ramp, &across, &down, &row, &column}) EXPECT_EQ(smoothed(gray(*picture), kWidth), gray(*picture));
}

TEST_F(Antialias, EdgePixelsGetTheirCoverage) {
  for (const double slope : {0.12, 0.3, 0.7, 1.4, 4.0}) {
    Gray stairs(kHeight, std::vector<double>(kWidth)), covered = stairs;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const auto inside = [&](double px, double py) { return py - 18.3 < slope * (px - 26.1); };
        int sum = 0;
        for (int row = 0; row < 16; ++row)
          for (int column = 0; column < 16; ++column) sum += inside(x + (column + 0.5) / 16, y + (row + 0.5) / 16);
        covered[y][x] = std::sqrt(0.1 * 0.1 + (0.9 * 0.9 - 0.1 * 0.1) * sum / 256);  // light, the square of the stored value
        stairs[y][x] = inside(x + 0.5, y + 0.5) ? 0.9 : 0.1;
      }
    const auto before = gray(stairs), after = smoothed(before, kWidth);
    double was = 0, is = 0;
    for (uint32_t y = 1; y + 1 < kHeight; ++y)
      for (uint32_t x = 1; x + 1 < kWidth; ++x) {
        const uint32_t i = y * kWidth + x;
        was += std::pow((before[i] & 0xFF) / 255.0 - covered[y][x], 2);
        is += std::pow((after[i] & 0xFF) / 255.0 - covered[y][x], 2);
      }
    EXPECT_LT(is, 0.4 * was) << slope;
  }
}

// The transposed picture gives the transposed result.
TEST_F(Antialias, IsSymmetricInRowsAndColumns) {
  constexpr uint32_t kSide = 41;
  std::vector<uint32_t> picture, turned(kSide * kSide);
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) picture.push_back(3 * y + 11 < 4 * x ? packed(0.9, 0.2, 0.1) : packed(0.1, 0.2, 0.7));
  const auto transposed = [&](const std::vector<uint32_t>& from) {
    for (uint32_t k = 0; k < from.size(); ++k) turned[k % kSide * kSide + k / kSide] = from[k];
    return turned;
  };
  const auto after = smoothed(picture, kSide);
  EXPECT_NE(after, picture);
  EXPECT_EQ(smoothed(transposed(picture), kSide), transposed(after));
}

TEST_F(Antialias, KeepsColorsAndSizes) {
  // Red beside green of the same light has no contrast; a single pixel has no neighbors.
  std::vector<uint32_t> two;
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) two.push_back(i % kWidth < 26 ? packed(0.6, 0, 0) : packed(0, 0.6 * 0.299 / 0.587, 0));
  EXPECT_EQ(smoothed(two, kWidth), two);
  const std::vector<uint32_t> one{packed(0.3, 0.6, 0.9)};
  EXPECT_EQ(smoothed(one, 1), one);
  std::vector<uint32_t> wide;
  for (uint32_t x = 0; x < 4096; ++x) wide.push_back(x % 7 < 3 ? packed(0.8, 0.8, 0.8) : packed(0.1, 0.1, 0.1));
  EXPECT_EQ(smoothed(wide, 4096), wide);  // a row: edges across it alone
  EXPECT_EQ(smoothed(wide, 1), wide);
}

}  // namespace
}  // namespace rill::test
