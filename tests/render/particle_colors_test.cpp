// Colors of particles: by speed, compression and fluid, and of those asleep.
#include <limits>

#include "render/particle_view_rig.hpp"
#include "views/color_map.hpp"

namespace rill::test {
namespace particle_view_test {

TEST_F(ParticleViewOnGpu, ColorsShowSpeedAndCompression) {
  constexpr uint32_t kSize = 64;
  const uint32_t middle = kSize / 2;
  const auto channel = [&](const Picture& picture, int k) { return static_cast<int>((picture.at(middle, middle) >> (8 * k)) & 255); };
  const Picture slow = take({{0, 0, -4, 0, 0, 0, 1}}, kSize, kSize), fast = take({{0, 0, -4, 0, 1, 0, 1}}, kSize, kSize);
  EXPECT_GT(channel(fast, 0), channel(slow, 0) + 60);
  EXPECT_GT(channel(slow, 2), 2 * channel(slow, 0)) << "rest is blue";
  const auto compression = ParticleColor::Compression;
  const Picture loose = take({{0, 0, -4, 9, 0, 0, 0.5f}}, kSize, kSize, 0, compression),
                rest = take({{0, 0, -4, 0, 0, 0, 1}}, kSize, kSize, 0, compression);
  const Picture dense = take({{0, 0, -4, 0, 0, 0, 1.5f}}, kSize, kSize, 0, compression);
  EXPECT_EQ(difference(loose, rest), 0u) << "expansion counts as none";
  EXPECT_LT(channel(dense, 1), channel(rest, 1) - 60);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(difference(take({{0, 0, -4, nan, 0, 0, nan}}, kSize, kSize, 0, compression), rest), 0u);
}

TEST_F(ParticleViewOnGpu, DrawsNothingAsleepBeforeTheFirstStep) {
  constexpr uint32_t kSize = 64;
  scene_.gravity[1] = -9.81;
  const std::vector<Particle> still{{0, 0, -4}};
  const Picture awake = take(still, kSize, kSize);
  scene_.solver.sleep = true;
  EXPECT_EQ(difference(take(still, kSize, kSize), awake), 0u);
  const uint32_t asleep = take(still, kSize, kSize, 1).at(kSize / 2, kSize / 2);
  EXPECT_NEAR(asleep & 255, (asleep >> 16) & 255, 2) << "gray";
}

// Unlit particles have the exact color of the map; everything else is darker than the map.
TEST_F(ParticleViewOnGpu, UnlitColorsMatchTheMap) {
  constexpr uint32_t kSize = 96;
  scene_.domain = Domain{{-3, -0.6, -7}, {3, 2, -1}, 0};
  scene_.solids.push_back(Solid{SphereShape{{1.4, 0.2, -5}, 0.7}});
  for (const auto color : {ParticleColor::Speed, ParticleColor::Compression}) {
    double darkest = 1;
    for (int k = 0; k <= 16; ++k) {
      const Float3 c = mapColor(color, k / 16.0);
      darkest = std::min(darkest, 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
    }
    for (const double t : {0.0, 0.3, 0.77, 1.0}) {
      // The scale's end: see scaleMax(); a scene without gravity has the start's fastest, none here, and so 1 m/s.
      const float value = static_cast<float>(t * (color == ParticleColor::Speed ? 1 : 0.01));
      const Particle near{0, 0, -4, 0, value, 0, 1 + value}, aside{-0.9f, 0.3f, -4.6f, 0, value, 0, 1 + value};
      const Picture picture = take({near, aside}, kSize, kSize, 0, color, true);
      const Float3 wanted = mapColor(color, t);
      size_t own = 0, mixed = 0;
      for (const uint32_t pixel : picture.pixels) {
        const int r = pixel & 255, g = (pixel >> 8) & 255, b = (pixel >> 16) & 255;
        if (std::abs(r - srgbByte(wanted.x)) <= 2 && std::abs(g - srgbByte(wanted.y)) <= 2 && std::abs(b - srgbByte(wanted.z)) <= 2)
          ++own;
        else if (std::max({r, g, b}) > srgbByte(0.9 * darkest))
          ++mixed;  // an outline
      }
      EXPECT_GT(own, 400u) << t;
      EXPECT_LT(mixed, own / 3) << t;
    }
  }
}

TEST_F(ParticleViewOnGpu, ColorsOfFluidsAreTheirOwnOrTellThemApart) {
  constexpr uint32_t kSize = 96;
  scene_.fluids = {{.name = "water"}, {.name = "oil", .color = Double3{0.9, 0.6, 0.1}}, {.name = "sirup"}};
  const Float3 wanted[] = {fluidColor(0), {0.9f, 0.6f, 0.1f}, fluidColor(2)};
  for (size_t k = 0; k < 3; ++k) {
    Particle particle{0, 0, -4, 3, 0, 0, 1.2f};
    particle.fluid = float(k);
    const uint32_t pixel = take({particle}, kSize, kSize, 0, ParticleColor::Fluid, true).at(kSize / 2, kSize / 2);
    EXPECT_NEAR(pixel & 255, srgbByte(wanted[k].x), 2) << k;
    EXPECT_NEAR((pixel >> 8) & 255, srgbByte(wanted[k].y), 2) << k;
    EXPECT_NEAR((pixel >> 16) & 255, srgbByte(wanted[k].z), 2) << k;
  }
}

TEST(FluidColors, DifferInLightnessOrHue) {
  for (size_t a = 0; a < kMaxFluids; ++a)
    for (size_t b = 0; b < a; ++b) {
      const Float3 p = fluidColor(a), q = fluidColor(b);
      const int apart =
          std::abs(srgbByte(p.x) - srgbByte(q.x)) + std::abs(srgbByte(p.y) - srgbByte(q.y)) + std::abs(srgbByte(p.z) - srgbByte(q.z));
      EXPECT_GT(apart, 80) << a << " " << b;
    }
}

}  // namespace particle_view_test
}  // namespace rill::test
