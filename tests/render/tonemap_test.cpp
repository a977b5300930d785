// The tone curve against its formula (Khronos PBR Neutral) and sRGB's.
#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/shader_pass.hpp"
#include "render/surface_rig.hpp"
#include "views/scene_buffers.hpp"

namespace rill::test {
namespace {

using Light = std::array<double, 3>;

// Khronos PBR Neutral Tone Mapper, specification of May 2024, equations (1) to (6).
Light neutral(Light c) {
  constexpr double f90 = 0.04, ks = 0.8 - f90, kd = 0.15;
  const double x = std::min({c[0], c[1], c[2]});
  const double f = x <= 2 * f90 ? x - x * x / (4 * f90) : f90;
  for (double& channel : c) channel -= f;
  const double p = std::max({c[0], c[1], c[2]});
  if (p <= ks) return c;
  const double pn = 1 - (1 - ks) * (1 - ks) / (p + 1 - 2 * ks), g = 1 / (kd * (p - pn) + 1);
  for (double& channel : c) channel = channel * pn / p * g + pn * (1 - g);
  return c;
}

class ToneMap : public GpuTest {
 protected:
  /// The bytes that become of linear colors.
  std::vector<std::array<uint8_t, 4>> mapped(const std::vector<std::array<float, 4>>& colors) {
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
    addDispatch(graph, "tone", tonemap, (texels.size() + 63) / 64, NoPush{}, {{"hdr", image}, {"aliased", picture}});
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
  for (const float scale : {1.0f, 0.05f, 0.003f, 8.0f, 1000.0f, 60000.0f})  // all branches of both curves
    for (int r = 0; r <= 8; ++r)
      for (int g = 0; g <= 8; ++g)
        for (int b = 0; b <= 8; ++b) colors.push_back({scale * float(r) / 8, scale * float(g) / 8, scale * float(b) / 8, 1});
  const auto got = mapped(colors);
  for (size_t i = 0; i < colors.size(); ++i) {
    const Light wanted = neutral({double{colors[i][0]}, double{colors[i][1]}, double{colors[i][2]}});
    for (size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(got[i][c], 255 * encodedSrgb(std::clamp(wanted[c], 0.0, 1.0)), 0.5 + 0.1 + 0.02)  // sRGB's power is a polynomial there
          << colors[i][0] << " " << colors[i][1] << " " << colors[i][2] << ", channel " << c;
    ASSERT_EQ(got[i][3], 255);
  }
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
