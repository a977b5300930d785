// The fluid in a host's targets: formats, depth conventions, viewports and occlusion.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/surface_rig.hpp"

namespace rill::test {
namespace {

class FluidInTargets : public SurfaceOnGpu {
 protected:
  static constexpr uint32_t kSmall = 96, kSmallHeight = 72;
  /// Small enough for many pictures: a block of fluid with the backdrop on all sides.
  static FluidView small() { return looking({0, 0, 0}, {0, 0, -4}, kSmall, kSmallHeight); }
  void fillSmall() { fill(block({-0.8, -0.7, -4.6}, {0.8, 0.7, -4})); }

  /// Pixels of two pictures that differ by more than `limit` in a channel.
  static size_t others(const Drawn& a, const Drawn& b, double limit) {
    const auto p = a.channels(VK_FORMAT_R16G16B16A16_SFLOAT), q = b.channels(VK_FORMAT_R16G16B16A16_SFLOAT);
    EXPECT_EQ(p.size(), q.size());
    size_t count = 0;
    for (size_t i = 0; i < p.size(); ++i) {
      double apart = 0;
      for (size_t c = 0; c < 4; ++c) apart = std::max(apart, std::abs(p[i][c] - q[i][c]));
      count += apart > limit ? 1 : 0;
    }
    return count;
  }
};

TEST_F(FluidInTargets, SrgbTargetEncodesTheLinearPicture) {
  fillSmall();
  Backdrop backdrop;
  backdrop.color = {1, 0, 1, 1};  // the same in every format
  const FluidView view = small();
  const VkFormat hdr = VK_FORMAT_R32G32B32A32_SFLOAT;
  const auto wanted = drawn(view, {}, backdrop, {.color = hdr}).channels(hdr);
  size_t fluid = 0, between = 0;
  for (const auto& pixel : wanted) {
    fluid += pixel[1] > 0 ? 1 : 0;
    between += pixel[0] > 0.05 && pixel[0] < 0.9 ? 1 : 0;
  }
  EXPECT_GT(fluid, wanted.size() / 10);
  EXPECT_LT(fluid, wanted.size() / 2);
  EXPECT_GT(between, fluid / 2) << "of black and white every curve is the same";
  for (const VkFormat format : {VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_SRGB}) {
    const bool srgb = format == VK_FORMAT_R8G8B8A8_SRGB, bytes = format != VK_FORMAT_R16G16B16A16_SFLOAT;
    const auto got = drawn(view, {}, backdrop, {.color = format}).channels(format);
    ASSERT_EQ(got.size(), wanted.size());
    for (size_t i = 0; i < got.size(); ++i)
      for (size_t c = 0; c < 4; ++c) {
        double a = got[i][c], b = wanted[i][c];
        if (bytes) b = std::clamp(b, 0.0, 1.0);
        if (srgb && c < 3) a = encodedSrgb(a), b = encodedSrgb(b);
        ASSERT_NEAR(a, b, bytes ? 1.0 / 255 : std::abs(b) / 1024) << "format " << format << ", pixel " << i << ", channel " << c;
      }
  }
}

// Equal pictures, and the surface's depth as each projection stores it.
TEST_F(FluidInTargets, PictureDoesNotDependOnTheDepthConvention) {
  fillSmall();
  const FluidView infinite = small();
  const Drawn wanted = drawn(infinite, {});
  const double near = double{infinite.projection.column[3].z};
  constexpr double kNear = 0.1;
  const auto found = surface(infinite);
  size_t fluid = 0;
  for (size_t i = 0; i < wanted.depth.size(); ++i) {
    if (wanted.depth[i] == 0 || std::isinf(found[i].depth)) continue;  // a pixel at an edge has a depth, but counts as no fluid
    ++fluid;
    ASSERT_NEAR(near / double{wanted.depth[i]}, double{found[i].depth}, 1e-5);
  }
  EXPECT_GT(fluid, wanted.depth.size() / 10);
  for (const auto& [reversed, far] : {std::pair{false, 40.0}, {true, 40.0}, {false, 1e30}}) {  // the last one's far plane is infinitely far
    Backdrop backdrop;
    backdrop.depth = reversed ? 0.0f : 1.0f;
    const Drawn got = drawn(finite(infinite, kNear, far, reversed), {}, backdrop);
    EXPECT_LT(others(got, wanted, 1e-3), wanted.depth.size() / 500) << reversed << far;
    size_t elsewhere = 0;
    for (size_t i = 0; i < wanted.depth.size(); ++i) {
      if (wanted.depth[i] == 0 || got.depth[i] == backdrop.depth) {
        elsewhere += (wanted.depth[i] == 0) != (got.depth[i] == backdrop.depth) ? 1 : 0;
        continue;
      }
      const double meters = near / double{wanted.depth[i]};
      const double part = far / (far - kNear) * (1 - kNear / meters);  // 0 at the near plane, 1 at the far one
      elsewhere += std::abs(double{got.depth[i]} - (reversed ? 1 - part : part)) > 1e-5 ? 1 : 0;
    }
    EXPECT_LT(elsewhere, wanted.depth.size() / 500) << reversed << far;
  }
}

TEST_F(FluidInTargets, OrthographicViewDrawsTheFluidInPlace) {
  fillSmall();
  const double half = 1.2, pixel = 2 * half / kSmallHeight;
  for (const bool reversed : {false, true}) {
    Backdrop backdrop;
    backdrop.color = {1, 0, 1, 1};
    backdrop.depth = reversed ? 0.0f : 1.0f;
    FluidView view = orthographic(half, small());
    if (reversed) {
      view.projection.column[2].z *= -1;
      view.projection.column[3].z = 1;
    }
    const Drawn got = drawn(view, {}, backdrop);
    const auto colors = got.channels(VK_FORMAT_R16G16B16A16_SFLOAT);
    for (uint32_t y = 0; y < kSmallHeight; ++y)
      for (uint32_t x = 0; x < kSmall; ++x) {
        const size_t i = size_t{y} * kSmall + x;
        const double across = std::abs((x + 0.5 - 0.5 * kSmall) * pixel), up = std::abs((y + 0.5 - 0.5 * kSmallHeight) * pixel);
        if (across < 0.8 - kSpacing && up < 0.7 - kSpacing) {
          const double part = reversed ? 1 - double{got.depth[i]} : double{got.depth[i]};
          ASSERT_NEAR(part * 100, 4, 0.5 * kSpacing) << x << " " << y;
          ASSERT_GT(colors[i][1], 0.01) << x << " " << y;
        } else if (across > 0.8 + kSpacing || up > 0.7 + kSpacing) {
          ASSERT_EQ(got.depth[i], backdrop.depth) << x << " " << y;
          ASSERT_EQ(colors[i], (std::array<double, 4>{1, 0, 1, 1})) << x << " " << y;
        }
      }
  }
}

// Inside, the bits of a target of the viewport's size; outside, those of the host.
TEST_F(FluidInTargets, DrawsOnlyInTheViewport) {
  fillSmall();
  const FluidView whole = small();
  const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
  constexpr uint32_t kTarget = 171, kTargetHeight = 133;
  std::uniform_real_distribution<float> any(0, 1);
  Backdrop around, own;
  around.pixels.resize(size_t{kTarget} * kTargetHeight);
  for (auto& pixel : around.pixels)
    for (float& channel : pixel) channel = any(random_);
  for (const auto& [left, top] : {std::pair{0u, 0u}, {37u, 23u}, {kTarget - kSmall, kTargetHeight - kSmallHeight}}) {
    own.pixels.clear();
    for (uint32_t y = 0; y < kSmallHeight; ++y)
      for (uint32_t x = 0; x < kSmall; ++x) own.pixels.push_back(around.pixels[(size_t{top} + y) * kTarget + left + x]);
    const Drawn wanted = drawn(whole, {}, own, {.color = format});
    FluidView view = whole;
    view.x = left;
    view.y = top;
    const Drawn got = drawn(view, {}, around, {.color = format}, kTarget, kTargetHeight);
    size_t fluid = 0;
    for (uint32_t y = 0; y < kTargetHeight; ++y)
      for (uint32_t x = 0; x < kTarget; ++x) {
        const size_t i = size_t{y} * kTarget + x;
        const bool inside = x >= left && x < left + kSmall && y >= top && y < top + kSmallHeight;
        const size_t j = inside ? (size_t{y} - top) * kSmall + (x - left) : 0;
        const void* color = inside ? static_cast<const void*>(&wanted.color[16 * j]) : around.pixels[i].data();
        fluid += got.depth[i] > 0 ? 1 : 0;
        ASSERT_EQ(got.depth[i], inside ? wanted.depth[j] : 0) << x << " " << y;
        ASSERT_EQ(std::memcmp(&got.color[16 * i], color, 16), 0) << x << " " << y << (inside ? " inside" : " outside");
      }
    EXPECT_GT(fluid, size_t{kSmall} * kSmallHeight / 10);
  }
}

TEST_F(FluidInTargets, RejectsViewportOutsideTheTargets) {
  fill(block({-1, -1, -5}, {1, 1, -4}));
  Graph graph;
  (void)renderer().addTo(graph, state(graph), hosts(graph, {}, 8, 8, {}), perspective(), {}, false);
  const auto ok = graph.compile();
  ASSERT_FALSE(ok);
  EXPECT_EQ(ok.error().message, "the fluid's viewport of 320x240 pixels at 0, 0 does not lie within a target of 8x8");
}

TEST_F(FluidInTargets, FluidAndSceneOccludeEachOther) {
  fill(block({-3, -3, -5}, {3, 3, -4}));
  const FluidView view = small();
  const double near = double{view.projection.column[3].z};
  FluidLook look;
  look.opaque = true;
  look.scatter = {0, 0, 1};
  for (const double wall : {3.0, 6.0}) {  // before the fluid, behind it
    Backdrop backdrop;
    backdrop.color = {1, 0, 0, 1};
    backdrop.depth = static_cast<float>(near / wall);
    const Drawn got = drawn(view, look, backdrop);
    const size_t middle = size_t{kSmallHeight} / 2 * kSmall + kSmall / 2;
    const bool seen = wall > 5;
    EXPECT_NEAR(near / double{got.depth[middle]}, seen ? 4 : wall, seen ? 0.4 * kSpacing : 1e-4);
    const bool red = got.channels(VK_FORMAT_R16G16B16A16_SFLOAT)[middle] == std::array<double, 4>{1, 0, 0, 1};
    EXPECT_EQ(red, !seen);
  }
}

TEST_F(FluidInTargets, RunsNothingWithoutParticles) {
  fill({});
  Graph graph;
  const TargetFormats formats;
  const SceneTargets targets{graph.create("color", {formats.color, 8, 8}), graph.create("depth", {formats.depth, 8, 8})};
  const SceneTargets after = renderer().addTo(graph, state(graph), targets, perspective(), {}, false);
  EXPECT_EQ(after.color, targets.color);
  EXPECT_EQ(after.depth, targets.depth);
  ASSERT_TRUE(graph.compile());
  for (const PassReport& report : graph.report()) EXPECT_EQ(report.runs, 0u) << report.name;
}

}  // namespace
}  // namespace rill::test
