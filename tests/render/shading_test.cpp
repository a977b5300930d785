// Shading of a flat pool against Fresnel, Snell and Beer-Lambert in double precision, in orthographic views (one angle) and in
// perspective (many angles).
#include <algorithm>
#include <cmath>

#include "render/surface_rig.hpp"

namespace rill::test {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
using Color = std::array<double, 4>;  // linear; the fourth is 1

/// Of unpolarized light that meets a surface at an angle (rad) to its normal: Fresnel's equations in the angles, by Snell's law.
double fresnel(double angle, double index) {
  if (angle < 1e-6) return std::pow((index - 1) / (index + 1), 2);
  const double inner = std::asin(std::sin(angle) / index);
  const double across = std::sin(angle - inner) / std::sin(angle + inner), within = std::tan(angle - inner) / std::tan(angle + inner);
  return 0.5 * (across * across + within * within);
}

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

class FlatPool : public SurfaceOnGpu {
 protected:
  static constexpr uint32_t kAcross = 160, kDown = 120;
  static constexpr double kDistance = 5;

  /// A pool of this depth whose surface is y = 0.
  void pool(double depth, double half = 2.6) { fill(block({-half, -depth, -half}, {half, 0, half}, 0)); }
  /// Seen at an angle (rad) from straight above, from the side of +z.
  static FluidView eye(double angle) {
    return looking({0, kDistance * std::cos(angle), kDistance * std::sin(angle)}, {0, 0, 0}, kAcross, kDown);
  }
  static FluidView parallel(double angle) { return orthographic(0.5, eye(angle)); }
  static Vector sightOf(double angle) { return {0, -std::cos(angle), -std::sin(angle)}; }

  static FluidLook clear() {
    FluidLook look;
    look.absorption = look.scatter = {0, 0, 0};
    look.sun = 0;
    look.toSun = {0, -1, 0};  // from below: no glow around it in what the pool mirrors
    return look;
  }
  std::vector<Color> seen(const FluidView& view, const FluidLook& look, std::array<float, 4> behind,
                          const std::vector<float>& depths = {}) {
    Backdrop backdrop;
    backdrop.depths = depths;
    backdrop.color = behind;
    backdrop.depth = view.projection.column[2].w == 0 ? 1.0f : 0.0f;  // as far as there is
    return drawn(view, look, backdrop, {.color = kFormat}).channels(kFormat);
  }
  /// What of the light behind comes through, whatever is mirrored: the difference that a white backdrop makes.
  std::vector<Color> through(const FluidView& view, const FluidLook& look) {
    auto white = seen(view, look, {1, 1, 1, 1});
    const auto black = seen(view, look, {0, 0, 0, 1});
    for (size_t i = 0; i < white.size(); ++i)
      for (size_t c = 0; c < 3; ++c) white[i][c] -= black.at(i)[c];
    return white;
  }
  static Color mean(const std::vector<Color>& pixels) {
    Color sum{};
    for (const Color& pixel : pixels)
      for (size_t c = 0; c < 4; ++c) sum[c] += pixel[c] / double(pixels.size());
    return sum;
  }
};

TEST_F(FlatPool, TransmitsWhatItDoesNotReflect) {
  pool(0.3, 4);
  for (const float index : {1.333f, 2.0f}) {
    FluidLook look = clear();
    look.refractionIndex = index;
    // From 27 to 73 degrees in one picture.
    const FluidView view = eye(50 * kDegree);
    const auto light = through(view, look);
    double steepest = 90, flattest = 0;
    for (uint32_t y = 0; y < kDown; ++y)
      for (uint32_t x = 0; x < kAcross; ++x) {
        const double across = (x + 0.5) / kAcross * 2 - 1, down = (y + 0.5) / kDown * 2 - 1, tangent = std::tan(22.5 * kDegree);
        const Vector forward = sightOf(50 * kDegree), up{0, std::sin(50 * kDegree), -std::cos(50 * kDegree)};
        const Vector sight = unit(forward + Vector{1, 0, 0} * (across * tangent * kAcross / kDown) - up * (down * tangent));
        const double angle = std::acos(-sight.y);
        const double away = kDistance * std::cos(50 * kDegree) / -sight.y;
        const Vector hit = Vector{0, kDistance * std::cos(50 * kDegree), kDistance * std::sin(50 * kDegree)} + sight * away;
        if (std::abs(hit.x) > 3.5 || std::abs(hit.z) > 3.5) continue;
        steepest = std::min(steepest, angle / kDegree);
        flattest = std::max(flattest, angle / kDegree);
        for (size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(light[size_t{y} * kAcross + x][c], 1 - fresnel(angle, double{index}), 0.01) << angle / kDegree << " degrees";
      }
    EXPECT_LT(steepest, 30);
    EXPECT_GT(flattest, 65);
  }
}

// A film on a floor, which refracted rays meet nearer than straight ones do: absorbed is at least what its depth absorbs.
TEST_F(FlatPool, FilmOnAFloorAbsorbsAtAnyAngle) {
  constexpr double kDepth = 0.3;
  pool(kDepth);
  FluidLook look = clear();
  for (const double angle : {40 * kDegree, 60 * kDegree, 75 * kDegree}) {
    const FluidView view = parallel(angle);
    std::vector<float> floor;
    for (uint32_t y = 0; y < kDown; ++y) {
      const double up = 0.5 - (y + 0.5) / kDown, z = kDistance + (up * std::sin(angle) + kDepth) / std::cos(angle);  // m, along the view
      floor.insert(floor.end(), kAcross, static_cast<float>(-view.projection.column[2].z * z));
    }
    for (const float rate : {3.0f, 30.0f}) {
      look.absorption = {rate, rate, rate};
      const auto white = seen(view, look, {1, 1, 1, 1}, floor), black = seen(view, look, {0, 0, 0, 1}, floor);
      for (size_t i = 0; i < white.size(); ++i)
        ASSERT_LT(white[i][1] - black[i][1], 1.1 * std::exp(-rate * kDepth) + 1e-3) << angle / kDegree << " degrees, pixel " << i;
    }
  }
}

// Twice the depth transmits the square, and a slanted ray is absorbed along its length.
TEST_F(FlatPool, AbsorptionFollowsBeerLambert) {
  FluidLook look = clear();
  look.absorption = {2.5f, 0.8f, 0.2f};
  const double rates[] = {2.5, 0.8, 0.2};
  for (const double depth : {0.3, 0.6, 1.2})
    for (const double angle : {0.0, 40 * kDegree}) {
      pool(depth);
      const auto light = through(parallel(angle), look);
      const Color whole = mean(light);
      const double meters = depth / std::cos(angle), left = 1 - fresnel(angle, double{look.refractionIndex});
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(std::log(whole[c] / left) / -rates[c], meters, 0.02 * meters + 0.002 / rates[c]) << depth << " m, channel " << c;
        for (const Color& pixel : light)
          ASSERT_NEAR(pixel[c] / left, std::exp(-rates[c] * meters), 0.12 * rates[c] * meters * std::exp(-rates[c] * meters) + 0.005);
      }
    }
}

// Through two layers, by the sum of their lengths times their absorptions.
TEST_F(FlatPool, LayersAbsorbOneAfterTheOther) {
  constexpr double kRates[2][3] = {{2.5, 0.8, 0.2}, {0.1, 0.7, 3}};
  bodies_ = {{.absorption = Float3{2.5f, 0.8f, 0.2f}}, {}};
  FluidLook look = clear();
  look.absorption = {0.1f, 0.7f, 3};  // of the other
  for (const double upper : {0.2, 0.5})
    for (const double angle : {0.0, 40 * kDegree}) {
      const double lower = 0.7 - upper;
      auto particles = block({-2.6, -0.7, -2.6}, {2.6, 0, 2.6}, 0);
      for (Float4& p : particles) p.w = double{p.y} > -upper ? 1.0f : 0.0f;
      fill(particles);
      const auto light = through(parallel(angle), look);
      const Color whole = mean(light);
      const double left = 1 - fresnel(angle, double{look.refractionIndex}), slant = 1 / std::cos(angle);
      for (size_t c = 0; c < 3; ++c) {
        const double depth = (kRates[0][c] * lower + kRates[1][c] * upper) * slant, rate = std::max(kRates[0][c], kRates[1][c]);
        EXPECT_NEAR(-std::log(whole[c] / left), depth, 0.02 * rate * 0.7 * slant + 0.002) << upper << " m, channel " << c;
        for (const Color& pixel : light)
          ASSERT_NEAR(pixel[c] / left, std::exp(-depth), 0.12 * depth * std::exp(-depth) + 0.01) << upper << " m, channel " << c;
      }
    }
}

// What a mixture scatters is the mean over what it absorbs; what one fluid emits, the other does not.
TEST_F(FlatPool, MixturesScatterTheMeanOfTheirFluids) {
  auto particles = block({-2.6, -0.6, -2.6}, {2.6, 0, 2.6}, 0);
  FluidLook look = clear();
  look.absorption = {30, 20, 10};
  look.scatter = {0.1f, 0.5f, 0.9f};
  look.emission = {0, 4, 0};
  const std::array<float, 4> black{0, 0, 0, 1};
  const auto picture = [&](float fluid) {
    const auto cell = [](float x) { return int(std::floor(x / kSpacing)); };
    for (Float4& p : particles) p.w = fluid < 0 ? float((cell(p.x) + cell(p.y) + cell(p.z)) & 1) : fluid;
    fill(particles);
    return mean(seen(parallel(0.3), look, black));
  };
  bodies_ = {{}, {.absorption = Float3{10, 20, 30}, .scatter = {0.8f, 0.4f, 0.2f}}};
  const Color first = picture(0), second = picture(1), both = picture(-1);
  EXPECT_GT(first[1], second[1] + 3);
  constexpr double kShare[] = {0.75, 0.5, 0.25};  // of the first: of absorptions
  for (size_t c = 0; c < 3; ++c) {
    const double wanted = kShare[c] * first[c] + (1 - kShare[c]) * second[c];
    EXPECT_NEAR(both[c], wanted, 0.02 * wanted) << "channel " << c;
  }
}

// A thick fluid below a clear one is seen in the light that this lets through, one above it in its own color.
TEST_F(FlatPool, LightComesThroughTheFluidInFront) {
  auto particles = block({-2.6, -0.8, -2.6}, {2.6, 0, 2.6}, 0);
  FluidLook look = clear();
  look.absorption = {60, 60, 60};
  look.scatter = {0.8f, 0.8f, 0.8f};
  bodies_ = {{}, {.absorption = Float3{4, 1, 0}}};
  const auto picture = [&](float above, float below) {
    for (Float4& p : particles) p.w = p.y > -0.4f ? above : below;
    fill(particles);
    return mean(seen(parallel(0), look, {0, 0, 0, 1}));
  };
  const Color milk = picture(0, 0), before = picture(0, 1), behind = picture(1, 0);
  constexpr double kRates[] = {4, 1, 0};
  const Color dark = picture(1, 1);  // nothing but its reflection
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(before[c], milk[c], 0.01 * milk[c]) << "channel " << c;
    const double wanted = dark[c] + (milk[c] - dark[c]) * std::exp(-kRates[c] * 0.4);
    EXPECT_NEAR(behind[c], wanted, 0.04 * wanted) << "channel " << c;
  }
}

// With one fluid the index in w is not read, and a body is a look.
TEST_F(FlatPool, OneFluidHasTheBitsOfItsLook) {
  FluidLook look;
  look.scattering = {0.5f, 0.5f, 0.5f};
  auto particles = block({-2.6, -0.3, -2.6}, {2.6, 0, 2.6});
  fill(particles);
  const Backdrop gray{.color = {0.5f, 0.5f, 0.5f, 1}, .depth = 1};
  const auto plain = drawn(parallel(0.4), look, gray);
  for (Float4& p : particles) p.w = 3;
  fill(particles);
  EXPECT_TRUE(drawn(parallel(0.4), look, gray).color == plain.color);
  bodies_ = {{}};
  EXPECT_TRUE(drawn(parallel(0.4), look, gray).color == plain.color);
  bodies_ = {{.absorption = Float3{9, 5, 1}, .scatter = {0.1f, 0.2f, 0.3f}}};
  const auto body = drawn(parallel(0.4), look, gray);
  bodies_.clear();
  look.absorption = {9, 5, 1};
  look.scatter = {0.1f, 0.2f, 0.3f};
  look.scattering = {0, 0, 0};
  EXPECT_TRUE(drawn(parallel(0.4), look, gray).color == body.color);
}

// Kirchhoff's law: emissivity is absorptance.
TEST_F(FlatPool, EmitsAsMuchAsItAbsorbs) {
  const double rates[] = {9, 2.5, 0.5}, glow[] = {2, 0.5, 0.25};
  for (const bool opaque : {false, true})
    for (const double angle : {0.0, 40 * kDegree}) {
      pool(0.3);
      FluidLook look = clear();
      look.opaque = opaque;
      look.absorption = {9, 2.5f, 0.5f};
      const std::array<float, 4> black{0, 0, 0, 1};
      const Color dark = mean(seen(parallel(angle), look, black));
      look.emission = {2, 0.5f, 0.25f};
      const Color bright = mean(seen(parallel(angle), look, black));
      const double meters = 0.3 / std::cos(angle), left = 1 - fresnel(angle, double{look.refractionIndex});
      for (size_t c = 0; c < 3; ++c) {
        const double emitted = left * glow[c] * (opaque ? 1 : 1 - std::exp(-rates[c] * meters));
        EXPECT_NEAR(bright[c] - dark[c], emitted, 0.02 * emitted) << opaque << " channel " << c;
      }
    }
}

// Sunlight from above and from below, through a slab: the integral along the view ray, by Simpson's rule.
TEST_F(FlatPool, ScattersSunlightOnceAsASlabDoes) {
  const double rates[] = {1.2, 0.5, 0.1}, coefficients[] = {0.4, 0.3, 0.6}, white[] = {1, 0.95, 0.88};
  const std::array<float, 4> black{0, 0, 0, 1};
  for (const double depth : {0.4, 1.0})
    for (const double degrees : {0.0, 30.0, 150.0, 180.0})
      for (const double g : {0.0, 0.7}) {
        pool(depth, 4);
        FluidLook look = clear();
        look.absorption = {1.2f, 0.5f, 0.1f};
        const Vector sun{std::sin(degrees * kDegree), std::cos(degrees * kDegree), 0};
        look.toSun = {float(sun.x), float(sun.y), 0};
        look.meanCosine = static_cast<float>(g);
        const Color dark = mean(seen(parallel(0), look, black));
        look.scattering = {0.4f, 0.3f, 0.6f};
        const Color bright = mean(seen(parallel(0), look, black));
        const double across = std::abs(sun.y), left = 1 - fresnel(0, double{look.refractionIndex});
        const double phase = (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g + 2 * g * sun.y, 1.5));
        for (size_t c = 0; c < 3; ++c) {
          const auto light = [&](double s) { return std::exp(-rates[c] * (s + (sun.y > 0 ? s : depth - s) / across)); };
          constexpr int kParts = 100;
          double sum = 0;
          for (int k = 0; k < kParts; ++k) {
            const double a = depth * k / kParts, b = depth * (k + 1) / kParts;
            sum += (b - a) / 6 * (light(a) + 4 * light(0.5 * (a + b)) + light(b));
          }
          const double wanted = left * left * coefficients[c] * std::numbers::pi * white[c] * phase * sum;
          EXPECT_NEAR(bright[c] - dark[c], wanted, 0.02 * wanted) << depth << " m, " << degrees << " degrees, channel " << c;
        }
      }
}

TEST(LookPresets, HaveTheirColors) {
  const auto body = [&](std::string_view name) { return fluidLook(name)->scatter; };
  for (const std::string_view name : fluidLooks()) ASSERT_TRUE(fluidLook(name)) << name;
  EXPECT_FALSE(fluidLook("tar"));
  EXPECT_TRUE(body("pool").z > body("pool").y && body("pool").y > body("pool").x) << "blue";
  EXPECT_TRUE(body("sea").y > body("sea").z && body("sea").z > body("sea").x) << "green";
  EXPECT_TRUE(body("river").x > body("river").y && body("river").y > 2 * body("river").z) << "brown";
  EXPECT_TRUE(body("honey").x > 2 * body("honey").y && body("honey").y > 2 * body("honey").z) << "amber";
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

}  // namespace
}  // namespace rill::test
