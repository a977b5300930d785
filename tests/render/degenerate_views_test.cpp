// Degenerate views: all values are finite, and two runs give equal bits (compared by the fixture).
#include <algorithm>
#include <cmath>
#include <limits>

#include "render/surface_rig.hpp"

namespace rill::test {
namespace {

class DegenerateViews : public SurfaceOnGpu {
 protected:
  static constexpr SurfaceMethod kMethods[] = {SurfaceMethod::Planes, SurfaceMethod::CurvatureFlow, SurfaceMethod::NarrowRange};

  /// Draws and checks all values; returns the number of pixels with fluid.
  size_t fluidPixels(const FluidView& view, const FluidLook& look) {
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    Backdrop backdrop;
    backdrop.color = {0.25f, 0.5f, 0.75f, 1};
    const Drawn got = drawn(view, look, backdrop, {.color = format});
    size_t fluid = 0;
    for (const float depth : got.depth) {
      EXPECT_TRUE(depth >= 0 && depth <= 1) << depth;
      fluid += depth > 0 ? 1 : 0;
    }
    for (const auto& pixel : got.channels(format))
      for (const double channel : pixel) EXPECT_TRUE(channel >= 0 && channel < 1000) << channel;
    return fluid;
  }
  /// The minimum over all methods, one of them with an opaque look.
  size_t minFluidPixels(const FluidView& view) {
    size_t least = SIZE_MAX;
    for (const SurfaceMethod method : kMethods) {
      FluidLook look;
      look.surface = method;
      look.opaque = method == SurfaceMethod::NarrowRange;
      least = std::min(least, fluidPixels(view, look));
    }
    return least;
  }
  static float nearOf(const FluidView& view) { return view.projection.column[3].z; }
};

TEST_F(DegenerateViews, HandlesAnEyeInsideTheFluid) {
  fill(block({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}));
  const FluidView view = looking({0, 0, 0}, {0, 0, -1}, 96, 72);
  EXPECT_GT(minFluidPixels(view), 96u * 72 / 2);
}

TEST_F(DegenerateViews, HandlesAParticleThatFillsThePicture) {
  const FluidView view = looking({0, 0, 0}, {0, 0, -4}, 96, 72);
  // The ball of half a spacing that is drawn, so near that the picture's corners still hit it.
  fill({{0, 0, -0.1f - nearOf(view), 0}});
  EXPECT_GT(minFluidPixels(view), 96u * 72 / 2);
}

TEST_F(DegenerateViews, HandlesOnePixelAndAVeryWidePicture) {
  fill(block({-3, -0.3, -4.4}, {3, 0.3, -4}));
  EXPECT_EQ(minFluidPixels(looking({0, 0, 0}, {0, 0, -4}, 1, 1)), 1u);
  FluidView wide = looking({0, 0, 0}, {0, 0, -4}, 4096, 4);
  for (float* zoom : {&wide.projection.column[0].x, &wide.projection.column[1].y}) *zoom *= 200;  // 4096 pixels are 17 m there
  EXPECT_GT(minFluidPixels(wide), 4u * 1400);
}

// A row of particles that moves through the near plane fills less and less of the picture, and nothing in front of it.
TEST_F(DegenerateViews, ParticlesCrossTheNearPlaneSmoothly) {
  const FluidView view = looking({0, 0, 0}, {0, 0, -4}, 96, 72);
  const float near = nearOf(view), beyond = std::nextafter(near, 1.0f), before = std::nextafter(near, 0.0f);
  const auto seen = [&](float depth, SurfaceMethod method) {
    std::vector<Float4> row;
    for (int k = -2; k <= 2; ++k) row.push_back({0.02f * float(k), 0.01f * float(k), -depth, 0});
    fill(row);
    FluidLook look;
    look.surface = method;
    return fluidPixels(view, look);
  };
  for (const SurfaceMethod method : kMethods) {
    const size_t on = seen(near, method);
    EXPECT_GT(on, 96u * 72 / 3) << int(method);
    for (const float depth : {beyond, before}) EXPECT_NEAR(double(seen(depth, method)), double(on), 20) << int(method);
    EXPECT_GT(seen(near + 0.05f, method), 96u * 72 / 3) << int(method);
    EXPECT_GT(seen(near + 0.091f, method), 96u * 72 / 4) << int(method);
    EXPECT_EQ(seen(near - 0.091f, method), 0u) << int(method);
    EXPECT_EQ(seen(-0.5f, method), 0u) << int(method);
  }
}

// Seen from inside, the section with the near plane fills the picture and faces the eye.
TEST_F(DegenerateViews, NearPlaneInsideTheFluidIsASection) {
  fill(block({-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}));
  const FluidView view = looking({0.03, 0.02, 0}, {0, 0, -1}, 96, 72);
  for (const SurfaceMethod method : kMethods) {
    const auto pixels = surface(view, method);
    for (size_t i = 0; i < pixels.size(); ++i) {
      ASSERT_NEAR(pixels[i].depth, nearOf(view), 1e-5f) << int(method) << " " << i;
      ASSERT_LT(pixels[i].normal.z, -0.8) << int(method) << " " << i;
    }
  }
}

// One sphere covers more samples than a loop may have iterations (65,535 on lavapipe), and light is not refracted.
TEST_F(DegenerateViews, HandlesALargePictureFromInside) {
  fill(block({0, 0, 0}, {4, 3, 2.5}, 0));
  const FluidView view = looking({0.6667, 0.6667, 1.3333}, {10, 0.6667, 1.3333}, 400, 240);
  const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
  for (const SurfaceMethod method : kMethods) {
    const auto pixels = surface(view, method);
    for (size_t i = 0; i < pixels.size(); ++i) ASSERT_NEAR(pixels[i].depth, nearOf(view), 1e-5f) << int(method) << " " << i;
    FluidLook look;
    look.surface = method;
    look.absorption = look.scatter = {0, 0, 0};
    Backdrop ramp;
    for (uint32_t y = 0; y < view.height; ++y)
      for (uint32_t x = 0; x < view.width; ++x) ramp.pixels.push_back({float(x), float(y), 0, 1});
    const auto seen = drawn(view, look, ramp, {.color = format}).channels(format);
    for (size_t i = 0; i < seen.size(); ++i)
      for (size_t c = 0; c < 2; ++c) ASSERT_NEAR(seen[i][c], double(ramp.pixels[i][c]), 0.6) << int(method) << " " << i;
  }
}

TEST_F(DegenerateViews, IgnoresNonFiniteParticles) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const FluidView view = looking({0, 0, 0}, {0, 0, -4}, 96, 72);
  std::vector<Float4> cloud = block({-0.5, -0.5, -4.5}, {0.5, 0.5, -4});
  fill(cloud);
  const size_t wanted = minFluidPixels(view);
  EXPECT_GT(wanted, 100u);
  for (const Float4& bad :
       {Float4{nan, 0, -4, 0}, Float4{0, nan, nan, 0}, Float4{0, 0, -inf, 0}, Float4{inf, -inf, -4, 0}, Float4{0, 0, -3e38f, 0}})
    cloud.insert(cloud.begin() + std::ptrdiff_t(cloud.size() / 2), bad);
  fill(cloud);
  EXPECT_EQ(minFluidPixels(view), wanted);
}

}  // namespace
}  // namespace rill::test
