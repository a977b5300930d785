// Light inside a flat pool against Fresnel and Beer-Lambert in double precision: absorbed, scattered, emitted.
#include <algorithm>
#include <numbers>

#include "render/flat_pool.hpp"

namespace rill::test {
namespace shading_test {

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

}  // namespace shading_test
}  // namespace rill::test
