// The window's pixels on surfaces of other formats than its picture.
#include "view/window_pass.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "support/gpu_test.hpp"

namespace rill::view {
namespace {

constexpr uint32_t kSide = 16;  // 256 pixels: every value of a channel

struct Packing {
  const char* name;
  VkFormat format;
  bool encodes;
  uint32_t shift[3], bits;  ///< of red, green, blue in a little-endian word
};
void PrintTo(const Packing& packing, std::ostream* out) { *out << packing.name; }

class SurfaceCopyTest : public test::GpuTest, public ::testing::WithParamInterface<Packing> {};

TEST_P(SurfaceCopyTest, KeepsEverySrgbValue) {
  const Packing& packing = GetParam();
  ImFontAtlas fonts;
  fonts.AddFontDefault();
  auto pass =
      WindowPass::create(device(), {VK_FORMAT_R8G8B8A8_UNORM, packing.format, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR, packing.encodes}, fonts);
  ASSERT_TRUE(pass) << pass.error().message;
  std::vector<uint32_t> values;
  for (uint32_t k = 0; k < kSide * kSide; ++k) values.push_back(k | (255 - k) << 8 | (k * 37 & 255) << 16 | 0xff000000);
  const Buffer given = upload("pixels", values);
  Graph graph;
  const BufferRef pixels = graph.import("pixels", importOf(given));
  ImageRef canvas = graph.create("canvas", {VK_FORMAT_R8G8B8A8_UNORM, kSide, kSide});
  graph.pass("fill", [&](Pass& fill) {
    fill.read(pixels, Use::CopySource);
    canvas = fill.write(canvas, Use::CopyTarget, Load::Discard);
    return [pixels, canvas](Commands& commands) { commands.copy(pixels, canvas); };
  });
  const ImageRef surface = (*pass)->copy(graph, canvas, graph.create("surface", {packing.format, kSide, kSide}));
  BufferRef bytes = graph.create("bytes", {values.size() * 4});
  graph.pass("read", [&](Pass& read) {
    read.read(surface, Use::CopySource);
    bytes = read.write(bytes, Use::CopyTarget, true);
    return [surface, bytes](Commands& commands) { commands.copy(surface, bytes); };
  });
  const Ticket ticket = graph.readback(bytes);
  run(graph);
  const auto words = read<uint32_t>(graph, ticket);
  ASSERT_EQ(words.size(), values.size());
  const int most = (1 << packing.bits) - 1;
  for (size_t k = 0; k < words.size(); ++k)
    for (uint32_t c = 0; c < 3; ++c) {
      const int expected = (static_cast<int>(values[k] >> 8 * c & 255) * most + 127) / 255;
      const int found = static_cast<int>(words[k] >> packing.shift[c]) & most;
      EXPECT_LE(std::abs(found - expected), 1) << "pixel " << k << ", channel " << c;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, SurfaceCopyTest,
                         ::testing::Values(Packing{"Bgra8Srgb", VK_FORMAT_B8G8R8A8_SRGB, true, {16, 8, 0}, 8},
                                           Packing{"Rgba8Srgb", VK_FORMAT_R8G8B8A8_SRGB, true, {0, 8, 16}, 8},
                                           Packing{"Bgr10", VK_FORMAT_A2B10G10R10_UNORM_PACK32, false, {0, 10, 20}, 10},
                                           Packing{"Rgb10", VK_FORMAT_A2R10G10B10_UNORM_PACK32, false, {20, 10, 0}, 10}),
                         [](const auto& packing) { return packing.param.name; });

}  // namespace
}  // namespace rill::view
