// Shading of a flat pool against Fresnel and Snell in double precision: what it reflects and refracts, spray and presets.
#include <algorithm>

#include "render/flat_pool.hpp"

namespace rill::test {
namespace shading_test {

double smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// The sky of shaders/render/sky.glsl; `up` is y.
double sky(int channel, Vector direction, Vector sun) {
  constexpr double zenith[] = {0.16, 0.30, 0.58}, horizon[] = {0.62, 0.74, 0.88}, ground[] = {0.09, 0.13, 0.16};
  constexpr double lampColor[] = {1, 0.97, 0.92}, glow[] = {1, 0.93, 0.82};
  const double up = std::clamp(direction.y, 0.0, 1.0), high = std::pow(up, 0.55), over = smooth(-0.08, 0.04, direction.y);
  const double above = horizon[channel] + (zenith[channel] - horizon[channel]) * high;
  const double base = ground[channel] + (above - ground[channel]) * over;
  const double x = std::abs(direction.x / direction.y + 0.35), z = std::abs(direction.z / direction.y + 0.55);
  const double lamp = up > 0.05 ? (1 - smooth(0.2, 1.5, x)) * (1 - smooth(0.1, 1.0, z)) * 0.9 : 0;
  return base + lampColor[channel] * lamp + glow[channel] * 0.5 * std::pow(std::max(dot(direction, sun), 0.0), 24);
}

TEST(LookPresets, HaveTheirColors) {
  const auto body = [&](std::string_view name) { return fluidLook(name)->scatter; };
  for (const std::string_view name : fluidLooks()) ASSERT_TRUE(fluidLook(name)) << name;
  EXPECT_FALSE(fluidLook("tar"));
  EXPECT_TRUE(body("pool").z > body("pool").y && body("pool").y > body("pool").x) << "blue";
  EXPECT_TRUE(body("sea").y > body("sea").z && body("sea").z > body("sea").x) << "green";
  EXPECT_TRUE(body("river").x > body("river").y && body("river").y > 2 * body("river").z) << "brown";
  EXPECT_TRUE(body("honey").x > 2 * body("honey").y && body("honey").y > 2 * body("honey").z) << "amber";
  const Float3 thick = fluidLook("lava")->absorption;  // what is behind lava would tint its glow
  for (const float rate : {thick.x, thick.y, thick.z}) EXPECT_LT(std::exp(-0.01f * rate), 0.06f);
  EXPECT_GT(fluidLook("lava")->emission.x, 5 * fluidLook("lava")->emission.y) << "red";
  for (const std::string_view name : {"water", "milk", "clay", "sea"}) EXPECT_EQ(fluidLook(name)->emission.x, 0) << name;
}

TEST_F(FlatPool, MatchesFormulaAtAnyAngle) {
  pool(0.4);
  for (const double degrees : {0.0, 20.0, 45.0, 65.0}) {
    const double angle = degrees * kDegree, meters = 0.4 / std::cos(angle);
    const Vector sight = sightOf(angle), mirrored{sight.x, -sight.y, sight.z};
    for (const bool sunny : {false, true}) {
      FluidLook look = clear();
      look.absorption = {1.2f, 0.5f, 0.1f};
      Vector sun{0, -1, 0};
      if (sunny) {  // where the pool mirrors it
        sun = mirrored;
        look.toSun = {float(sun.x), float(sun.y), float(sun.z)};
        look.sun = 3;
      }
      const double rates[] = {1.2, 0.5, 0.1}, behind[] = {0.7, 0.4, 0.9}, white[] = {1, 0.95, 0.88};
      const double part = fresnel(angle, double{look.refractionIndex});
      const auto pixels = seen(parallel(angle), look, {0.7f, 0.4f, 0.9f, 1});
      const Color whole = mean(pixels);
      for (int c = 0; c < 3; ++c) {
        const double mirror = sky(c, mirrored, sun) + (sunny ? 3 * white[c] : 0);
        const double wanted = part * mirror + (1 - part) * std::exp(-rates[c] * meters) * behind[c];
        EXPECT_NEAR(whole[size_t(c)], wanted, 0.01 * wanted) << degrees << " degrees, channel " << c << (sunny ? ", in the sun" : "");
        for (const Color& pixel : pixels) ASSERT_NEAR(pixel[size_t(c)], wanted, 0.07 * wanted) << degrees << " degrees, channel " << c;
      }
    }
  }
}

TEST_F(FlatPool, OpaqueFluidHasItsColorAndReflectsTheSky) {
  pool(0.2);
  for (const double degrees : {0.0, 60.0}) {
    const double angle = degrees * kDegree, part = fresnel(angle, 1.5);
    const Vector sight = sightOf(angle), mirrored{sight.x, -sight.y, sight.z}, sun = unit({0.6, 0.7, 0.2});
    FluidLook look = clear();
    look.opaque = true;
    look.scatter = {0.5f, 0.3f, 0.1f};
    look.refractionIndex = 1.5f;
    look.toSun = {float(sun.x), float(sun.y), float(sun.z)};
    const auto pixels = seen(parallel(angle), look, {9, 9, 9, 1});
    const double own[] = {0.5, 0.3, 0.1}, direct[] = {1, 0.95, 0.88};
    for (int c = 0; c < 3; ++c) {
      const double horizon[] = {0.62, 0.74, 0.88}, zenith[] = {0.16, 0.30, 0.58};
      const double ambient = horizon[c] + 0.4 * (zenith[c] - horizon[c]);  // all of the upper half, of a surface that lies flat
      const double wanted = part * sky(c, mirrored, sun) + (1 - part) * own[c] * (ambient + direct[c] * sun.y);
      for (const Color& pixel : pixels) ASSERT_NEAR(pixel[size_t(c)], wanted, 0.01 * wanted) << degrees << " degrees, channel " << c;
    }
  }
}

// The picture is shifted by the offset of the refracted ray after the pool's thickness along it.
TEST_F(FlatPool, RefractionFollowsSnell) {
  pool(0.3);
  for (const double degrees : {0.0, 30.0, 50.0}) {
    const double angle = degrees * kDegree;
    const FluidView view = parallel(angle);
    const FluidLook look = clear();
    Backdrop black, ramp;
    black.depth = ramp.depth = 1;
    for (uint32_t y = 0; y < kDown; ++y)
      for (uint32_t x = 0; x < kAcross; ++x) ramp.pixels.push_back({float(x) + 0.5f, float(y) + 0.5f, 0, 1});
    const auto dark = drawn(view, look, black, {.color = kFormat}).channels(kFormat);
    const auto light = drawn(view, look, ramp, {.color = kFormat}).channels(kFormat);
    const double inner = std::asin(std::sin(angle) / double{look.refractionIndex});
    const double meters = 0.3 / std::cos(angle), pixel = 1.0 / kDown;
    // Bent towards the normal, it comes out nearer to the eye's side than it went in: down the picture.
    const double shift = std::sin(angle - inner) * meters / pixel, left = 1 - fresnel(angle, double{look.refractionIndex});
    for (uint32_t y = 30; y < kDown - 30; ++y)
      for (uint32_t x = 30; x < kAcross - 30; ++x) {
        const size_t i = size_t{y} * kAcross + x;
        ASSERT_NEAR((light[i][0] - dark[i][0]) / left, x + 0.5, 0.2) << degrees << " degrees at " << x << " " << y;
        ASSERT_NEAR((light[i][1] - dark[i][1]) / left, y + 0.5 + shift, 0.2 + 0.08 * shift) << degrees << " degrees at " << x << " " << y;
      }
  }
}

// Rays that are bent onto a floor nearer to the eye, at angles where each step of the search overshoots.
TEST_F(FlatPool, RefractedRaysEndOnTheFloorAtAnyAngle) {
  constexpr double kDepth = 0.3, kPixel = 1.0 / kDown;
  pool(kDepth, 5);
  const FluidLook look = clear();
  for (const double degrees : {40.0, 60.0, 75.0}) {
    const double angle = degrees * kDegree, inner = std::asin(std::sin(angle) / double{look.refractionIndex});
    const FluidView view = parallel(angle);
    Backdrop black, ramp;
    for (uint32_t y = 0; y < kDown; ++y) {
      const double up = 0.5 - (y + 0.5) / kDown, z = kDistance + (up * std::sin(angle) + kDepth) / std::cos(angle);  // m, along the view
      black.depths.insert(black.depths.end(), kAcross, static_cast<float>(-view.projection.column[2].z * z));
      ramp.pixels.insert(ramp.pixels.end(), kAcross, {float(y) + 0.5f, 0, 0, 1});
    }
    ramp.depths = black.depths;
    const auto dark = drawn(view, look, black, {.color = kFormat}).channels(kFormat);
    const auto light = drawn(view, look, ramp, {.color = kFormat}).channels(kFormat);
    const double shift = kDepth * (std::sin(angle) - std::tan(inner) * std::cos(angle)) / kPixel;  // pixels
    const double left = 1 - fresnel(angle, double{look.refractionIndex});
    // The surface is within 0.4 spacings of its place.
    for (uint32_t y = 30; y < kDown - 45; ++y)
      for (uint32_t x = 30; x < kAcross - 30; ++x) {
        const size_t i = size_t{y} * kAcross + x;
        ASSERT_NEAR((light[i][0] - dark[i][0]) / left, y + 0.5 + shift, 0.5 + 0.13 * shift) << degrees << " degrees at " << x << " " << y;
      }
  }
}

// What thick fluid scatters is seen at its rims, too, where a reflected ray passes the fluid.
TEST_F(FlatPool, ThickFluidHasNoBlackRim) {
  fill(shells({0, 0, 0}, 0.5));
  FluidLook look = *fluidLook("milk");
  look.sun = 0;
  const auto picture = seen(orthographic(0.7, eye(1.5)), look, {1, 1, 1, 1});
  double darkest = 1;
  for (const Color& pixel : picture) darkest = std::min(darkest, pixel[1]);
  EXPECT_GT(darkest, 0.22);
}

// In gaps of a spacing between the layers of a thread planes meet at any angle. No pixel there mirrors the sky as a rim does.
TEST_F(FlatPool, GapsInAThreadDoNotMirrorTheSky) {
  FluidLook look = clear();
  look.absorption = {1e4f, 1e4f, 1e4f};
  size_t mirroring = 0;
  for (const int layers : {2, 3}) {  // between gaps
    std::vector<Float4> thread;
    double level = -0.8;
    for (int k = 0; level < 0.8; ++k) {
      for (const Float4& p : block({-0.5, level, -0.5}, {0.5, level + 0.099, 0.5}))
        if (std::hypot(p.x, p.z) < 0.4f) thread.push_back(p);
      level += k % layers == layers - 1 ? 0.2 : 0.1;
    }
    fill(thread);
    for (const double angle : {1.2, 1.3, 1.4, 1.5, 1.6, 1.7}) {
      const auto picture = seen(orthographic(0.9, eye(angle)), look, {0, 0, 0, 1});
      for (uint32_t y = 35; y < kDown - 35; ++y)
        for (uint32_t x = 64; x < 96; ++x) mirroring += picture[size_t{y} * kAcross + x][1] > 0.1;
    }
  }
  EXPECT_LT(mirroring, 40u);  // of 19,200; 111 with the planes' own normals
}

// A ball's lower rim, seen edge on, reflects the scene behind it if the fluid is transparent, and not if it is opaque.
TEST_F(FlatPool, OpaqueFluidHidesTheScene) {
  fill(shells({0, 0, 0}, 0.5));
  FluidLook look = clear();
  look.opaque = true;
  look.scatter = {0.5f, 0.5f, 0.5f};
  const FluidView view = orthographic(0.7, eye(1.5));
  const auto black = seen(view, look, {0, 0, 0, 1}), bright = seen(view, look, {9, 9, 9, 1});
  size_t fluid = 0, mixed = 0;
  for (size_t i = 0; i < black.size(); ++i) {
    if (bright[i][0] > 8.99) continue;  // none there
    if (std::abs(bright[i][0] - black[i][0]) < 1e-6)
      ++fluid;
    else
      ++mixed;  // a silhouette's pixel, which the fluid covers in part
  }
  EXPECT_GT(fluid, 4000u);
  EXPECT_LT(mixed, fluid / 15);
}

TEST_F(FlatPool, DropsDoNotRefract) {
  fill({{0, 0, 0, 0}});
  const FluidView view = orthographic(0.1, eye(0.3));
  Backdrop ramp;
  for (uint32_t k = 0; k < kAcross * kDown; ++k) ramp.pixels.push_back({float(k % kAcross), float(k / kAcross), 0, 1});
  ramp.depths.assign(size_t{kAcross} * kDown, 1.0f);
  FluidLook look = clear();
  look.aeration = 0;
  const auto picture = drawn(view, look, ramp, {.color = kFormat}).channels(kFormat);
  const Color& middle = picture[kDown / 2 * kAcross + kAcross / 2];
  EXPECT_NEAR(middle[0], kAcross / 2, 0.6);
  EXPECT_NEAR(middle[1], kDown / 2, 0.6);
}

// Spray would flicker. A larger ball reflects the sun.
TEST_F(FlatPool, DropsDoNotReflectTheSun) {
  const FluidView view = orthographic(0.1, eye(0.3)), wide = orthographic(0.7, eye(0.3));
  FluidLook dark = clear(), sunny = clear();
  sunny.sun = 100;
  dark.toSun = sunny.toSun = {0.2f, 1, 0.5f};
  fill({{0, 0, 0, 0}});
  EXPECT_EQ(seen(view, sunny, {0, 0, 0, 1}), seen(view, dark, {0, 0, 0, 1}));
  fill(shells({0, 0, 0}, 0.5));
  EXPECT_NE(seen(wide, sunny, {0, 0, 0, 1}), seen(wide, dark, {0, 0, 0, 1}));
}

// Drops scatter white light, a pool's middle does not.
TEST_F(FlatPool, WhitewaterIsWhiteAndLevelFluidIsNot) {
  FluidLook none = clear(), white = clear();
  none.aeration = 0;
  white.aeration = 0.5f;
  pool(0.6);
  const auto middle = [](const std::vector<Color>& picture) { return picture[kDown / 2 * kAcross + kAcross / 2]; };
  const FluidView above = parallel(0.3);
  EXPECT_EQ(middle(seen(above, white, {0, 0, 0, 1})), middle(seen(above, none, {0, 0, 0, 1})));
  fill({{0, 0, 0, 0}});
  const FluidView near = orthographic(0.1, eye(0.3));  // a drop in the middle, a third of the picture high
  const Color dark = middle(seen(near, none, {0, 0, 0, 1})), light = middle(seen(near, white, {0, 0, 0, 1}));
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_GT(light[c], dark[c] + 0.1);
    EXPECT_LT(light[c], dark[c] + 0.6);
  }
}

// A solid in front of the pool changes no other pixel, although refracted rays end behind it.
TEST_F(FlatPool, SceneInFrontIsNotRefracted) {
  pool(0.3);
  for (const double degrees : {0.0, 30.0, 50.0}) {
    const FluidView view = parallel(degrees * kDegree);
    Backdrop without;
    without.pixels.assign(size_t{kAcross} * kDown, {0.2f, 0.4f, 0.6f, 1});
    without.depths.assign(size_t{kAcross} * kDown, 1);
    Backdrop with = without;
    const auto isSolid = [](uint32_t x, uint32_t y) { return x >= 60 && x < 100 && y >= 50 && y < 80; };
    for (uint32_t y = 0; y < kDown; ++y)
      for (uint32_t x = 0; x < kAcross; ++x) {
        if (!isSolid(x, y)) continue;
        with.pixels[size_t{y} * kAcross + x] = {8, 0, 0, 1};
        with.depths[size_t{y} * kAcross + x] = 0.02f;  // 2 m from the eye
      }
    const auto wanted = drawn(view, clear(), without, {.color = kFormat}).channels(kFormat);
    const auto got = drawn(view, clear(), with, {.color = kFormat}).channels(kFormat);
    for (uint32_t y = 0; y < kDown; ++y)
      for (uint32_t x = 0; x < kAcross; ++x) {
        const size_t i = size_t{y} * kAcross + x;
        for (size_t c = 0; c < 3; ++c) {
          const double solid = c == 0 ? 8 : 0;
          ASSERT_NEAR(got[i][c], isSolid(x, y) ? solid : wanted[i][c], 0.01) << degrees << " degrees at " << x << " " << y;
        }
      }
  }
}

}  // namespace shading_test
}  // namespace rill::test
