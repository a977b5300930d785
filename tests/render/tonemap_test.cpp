// Exposure and tone curve against the formulas of AgX in double precision.
#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/shader_pass.hpp"
#include "render/surface_rig.hpp"
#include "views/scene_buffers.hpp"

namespace rill::test {
namespace {

using Light = std::array<double, 3>;
using Matrix = std::array<Light, 3>;  // rows

Light times(const Matrix& m, const Light& v) {
  Light out{};
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 3; ++c) out[r] += m[r][c] * v[c];
  return out;
}

Matrix inverse(const Matrix& m) {
  const auto minor = [&](size_t r, size_t c) {
    return m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] - m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix out;
  for (size_t r = 0; r < 3; ++r)
    for (size_t c = 0; c < 3; ++c) out[r][c] = minor(c, r) / determinant;
  return out;
}

/// From linear RGB to XYZ, of sRGB's primaries moved towards its white by a fraction `inset` of their distance.
Matrix toXyz(double inset) {
  constexpr double white[] = {0.3127, 0.3290}, primaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
  Matrix columns;
  for (size_t p = 0; p < 3; ++p) {
    const double x = primaries[p][0] + inset * (white[0] - primaries[p][0]), y = primaries[p][1] + inset * (white[1] - primaries[p][1]);
    columns[0][p] = x / y, columns[1][p] = 1, columns[2][p] = (1 - x - y) / y;
  }
  const Light scale = times(inverse(columns), {white[0] / white[1], 1, (1 - white[0] - white[1]) / white[1]});
  for (Light& row : columns)
    for (size_t p = 0; p < 3; ++p) row[p] *= scale[p];
  return columns;
}

// AgX of T. Sobotka (2022), half a stop brighter: 10 stops below and 6.5 above middle gray, slope 2 there, powers 3 of the toe and 3.25 of
// the shoulder. The curve is x / (1 + x^p)^(1/p), scaled so that it passes through the corners and the pivot. Look "Punchy": power 1.35,
// saturation 1.4.
Light agx(const Light& color) {
  Matrix inset{};
  for (size_t c = 0; c < 3; ++c) {
    const Matrix fromXyz = inverse(toXyz(0));
    const Light column = times(fromXyz, {toXyz(0.2)[0][c], toXyz(0.2)[1][c], toXyz(0.2)[2][c]});
    for (size_t r = 0; r < 3; ++r) inset[r][c] = column[r];
  }
  Light light = times(inset, color);
  for (double& c : light) {
    const double pivot = 10 / 16.5, x = std::clamp((std::log2(std::max(c, 1e-10) / 0.18) + 0.5 + 10) / 16.5, 0.0, 1.0);
    const bool toe = x < pivot;
    const double power = toe ? 3 : 3.25, width = toe ? pivot : 1 - pivot;
    const double scale = std::pow(std::pow(0.5, -power) - std::pow(2 * width, -power), -1 / power);
    const double at = 2 * std::abs(x - pivot) / scale, y = scale * at / std::pow(1 + std::pow(at, power), 1 / power);
    c = std::pow(std::max(toe ? 0.5 - y : 0.5 + y, 0.0), 1.35);
  }
  const double gray = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
  for (double& c : light) c = gray + 1.4 * (c - gray);
  return times(inverse(inset), light);
}

class ToneMap : public GpuTest {
 protected:
  /// The bytes that become of linear colors, times `gain`.
  std::vector<std::array<uint8_t, 4>> mapped(const std::vector<std::array<float, 4>>& colors, float gain = 1) {
    bringViewShaders(device());
    const ComputePipeline* tonemap = pipeline({.shader = "views/tonemap"});
    constexpr uint32_t kRow = 37;  // not a multiple of a workgroup
    const uint32_t rows = uint32_t(colors.size() + kRow - 1) / kRow;
    std::vector<std::array<float, 4>> texels = colors;
    texels.resize(size_t{kRow} * rows);
    const Buffer source = upload("texels", texels);
    Graph graph;
    const BufferRef in = graph.import("texels", importOf(source));
    ImageRef image = graph.create("light", {VK_FORMAT_R32G32B32A32_SFLOAT, kRow, rows});
    graph.pass("upload", [&](Pass& pass) {
      pass.read(in, Use::CopySource);
      image = pass.write(image, Use::CopyTarget);
      return [=](Commands& commands) { commands.copy(in, image); };
    });
    BufferRef picture = graph.create("picture", {texels.size() * 4});
    addDispatch(graph, "tone", tonemap, Groups{(kRow + 7) / 8, (rows + 7) / 8, 1}, gain, {{"hdr", image}, {"aliased", picture}});
    const Ticket ticket = graph.readback(picture);
    run(graph);
    auto bytes = read<std::array<uint8_t, 4>>(graph, ticket);
    EXPECT_EQ(bytes.size(), texels.size());
    bytes.resize(colors.size());
    return bytes;
  }
};

TEST_F(ToneMap, MatchesFormula) {
  std::vector<std::array<float, 4>> colors;
  for (const float scale : {1.0f, 0.05f, 0.003f, 8.0f, 1000.0f, 60000.0f})  // toe, shoulder and beyond both ends
    for (int r = 0; r <= 8; ++r)
      for (int g = 0; g <= 8; ++g)
        for (int b = 0; b <= 8; ++b) colors.push_back({scale * float(r) / 8, scale * float(g) / 8, scale * float(b) / 8, 1});
  for (const double gain : {1.0, 0.25, 4.0}) {
    const auto got = mapped(colors, float(gain));
    for (size_t i = 0; i < colors.size(); ++i) {
      const Light wanted = agx({gain * double{colors[i][0]}, gain * double{colors[i][1]}, gain * double{colors[i][2]}});
      for (size_t c = 0; c < 3; ++c)
        // The curve is a polynomial, within 0.7 of 255 steps; saturation enlarges that by up to 1.8, the way back to sRGB by 1.4.
        ASSERT_NEAR(got[i][c], 255 * std::clamp(wanted[c], 0.0, 1.0), 0.5 + 1.8 * 1.4 * 0.7)
            << colors[i][0] << " " << colors[i][1] << " " << colors[i][2] << ", gain " << gain << ", channel " << c;
      ASSERT_EQ(got[i][3], 255);
    }
  }
}

TEST_F(ToneMap, AStopIsAFactorOfTwo) {
  std::vector<std::array<float, 4>> dark, light;
  for (float x = 1e-4f; x < 100; x *= 1.1f) {
    dark.push_back({x, 0.5f * x, 0.1f * x, 1});
    light.push_back({2 * x, x, 0.2f * x, 1});
  }
  EXPECT_EQ(mapped(dark, 2), mapped(light));
  EXPECT_NE(mapped(dark), mapped(light));
}

TEST_F(ToneMap, IsMonotonicAndKeepsBlack) {
  std::vector<std::array<float, 4>> grays{{0, 0, 0, 0}};
  for (double light = 1e-4; light < 65504; light *= 1.002) grays.push_back({float(light), float(light), float(light), 1});
  const auto got = mapped(grays);
  EXPECT_EQ(got.front(), (std::array<uint8_t, 4>{0, 0, 0, 255}));
  EXPECT_EQ(got.back(), (std::array<uint8_t, 4>{255, 255, 255, 255}));
  for (size_t i = 1; i < got.size(); ++i) {
    ASSERT_GE(got[i][0], got[i - 1][0]) << grays[i][0];
    ASSERT_TRUE(got[i][0] == got[i][1] && got[i][1] == got[i][2]) << "gray stays gray, " << grays[i][0];
  }
}

TEST_F(ToneMap, MapsNanToBlackAndInfinityToWhite) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const float largest = std::numeric_limits<float>::max();
  const auto got = mapped({{-1, -1, -1, 1},
                           {-inf, -inf, -inf, 1},
                           {nan, nan, nan, 1},
                           {-0.0f, -0.0f, -0.0f, 1},  // black
                           {inf, inf, inf, 1},
                           {largest, largest, largest, 1},  // white
                           {0.5f, -3, 0.25f, 1},
                           {0.5f, 0, 0.25f, 1},  // the same
                           {0.5f, nan, 0.25f, 1}});
  const std::array<uint8_t, 4> black{0, 0, 0, 255}, white{255, 255, 255, 255};
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(got[i], black) << i;
  for (size_t i = 4; i < 6; ++i) EXPECT_EQ(got[i], white) << i;
  EXPECT_EQ(got[6], got[7]);
  EXPECT_EQ(got[8], got[7]);
}

}  // namespace
}  // namespace rill::test
