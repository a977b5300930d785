// Built-in skies.
#include <gtest/gtest.h>

#include <random>

#include "render/atmosphere.hpp"
#include "render/environment_pictures.hpp"
#include "rill/environment.hpp"

namespace rill::test {
namespace environment_test {

constexpr double kRadian = 180 / std::numbers::pi;

Double3 unitOf(const Double3& v) {
  const double size = std::sqrt(dotOf(v, v));
  return {v.x / size, v.y / size, v.z / size};
}
const Double3 kDaySun = unitOf({-0.85, 0.75, 0.40}), kSunsetSun = unitOf({-0.90, 0.14, -0.35});

Double3 towards(double elevation, double turn, const Double3& sun) {
  const double azimuth = std::atan2(sun.z, sun.x) + turn / kRadian, level = std::cos(elevation / kRadian);
  return {level * std::cos(azimuth), std::sin(elevation / kRadian), level * std::sin(azimuth)};
}

Rgb skyAlong(const EnvironmentPicture& sky, const Double3& to) {
  const auto row = std::min(uint32_t(std::acos(to.y) / std::numbers::pi * sky.height), sky.height - 1);
  const auto column = uint32_t((std::atan2(to.x, -to.z) / (2 * std::numbers::pi) + 0.5) * sky.width) % sky.width;
  return unpacked(sky.texels[row * sky.width + column]);
}

/// The texel in the direction that is `turn` degrees away from the sun's azimuth.
Rgb seen(const EnvironmentPicture& sky, double elevation, double turn, const Double3& sun) {
  return skyAlong(sky, towards(elevation, turn, sun));
}

double luminanceOf(const Rgb& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST(SkyPicture, HasTheSunOfItsName) {
  EXPECT_FALSE(skyPicture("studio"));
  EXPECT_FALSE(skyPicture("dya"));
  for (const auto& [name, to] : {std::pair{"day", kDaySun}, std::pair{"sunset", kSunsetSun}}) {
    const auto sky = skyPicture(name);
    ASSERT_TRUE(sky);
    const auto sun = findSun(*sky);
    ASSERT_TRUE(sun) << name;
    const Double3 found = {sun->direction.x, sun->direction.y, sun->direction.z};
    EXPECT_LT(std::acos(std::min(dotOf(found, to), 1.0)), std::numbers::pi / sky->height) << name;
  }
}

TEST(SkyPicture, IsExposedAndBalancedForTheGround) {
  const auto day = skyPicture("day"), sunset = skyPicture("sunset");
  const Rgb white = irradianceOf(*day, {0, 1, 0}), evening = irradianceOf(*sunset, {0, 1, 0});
  for (const double channel : white) EXPECT_NEAR(channel / std::numbers::pi, 1.9, 0.015) << "white ground is white by day";
  EXPECT_NEAR(luminanceOf(evening) / std::numbers::pi, 0.35, 0.005);
  const auto sun = findSun(*day), low = findSun(*sunset);
  EXPECT_LT(low->light.z / low->light.x, 0.4f * sun->light.z / sun->light.x) << "a low sun is red";
  // IES: 85 of 100 klx come from the sun.
  EXPECT_NEAR(sun->light.y * sun->direction.y / (white[1] / std::numbers::pi), 0.85, 0.05);
}

/// How far the chromaticity y lies above the CIE locus of daylight; pink is below.
double aboveDaylight(const Rgb& c) {
  const double x = 0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2], z = 0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2];
  const double sum = x + luminanceOf(c) + z, at = x / sum;
  return luminanceOf(c) / sum - (-3 * at * at + 2.87 * at - 0.275);
}

TEST(SkyPicture, DayIsBlueAboveAndWhiteAtTheHorizon) {
  const auto sky = skyPicture("day");
  const Rgb zenith = seen(*sky, 90, 0, kDaySun), opposite = seen(*sky, 32, 180, kDaySun);
  EXPECT_GT(zenith[2], 1.8 * zenith[0]);
  EXPECT_GT(opposite[2], 3 * opposite[0]) << "bluest at right angles to the sun";
  for (const double turn : {0.0, 60.0, 120.0, 180.0}) {
    for (const double elevation : {0.5, 1.0, 2.0, 4.0, 8.0, 20.0}) {
      // Clear skies that were measured lie on the locus or little above it (Hernandez-Andres et al. 2001).
      EXPECT_NEAR(aboveDaylight(seen(*sky, elevation, turn, kDaySun)), 0.006, 0.005) << elevation << " " << turn;
    }
    const Rgb low = seen(*sky, 1, turn, kDaySun);
    EXPECT_GT(luminanceOf(low), 1.3 * luminanceOf(zenith)) << turn;
    EXPECT_LT(low[2], 1.6 * low[0]) << "white at " << turn;
    if (turn > 0) { EXPECT_LT(luminanceOf(seen(*sky, 20, turn, kDaySun)), luminanceOf(low)) << turn; }
  }
}

TEST(SkyPicture, SunsetIsOrangeAtTheSunAndBlueAboveIt) {
  const auto sky = skyPicture("sunset");
  for (const double turn : {-8.0, 8.0}) {
    const Rgb glow = seen(*sky, 3, turn, kSunsetSun);
    EXPECT_GT(glow[0], 1.15 * glow[1]);
    EXPECT_GT(glow[1], 1.15 * glow[2]);
    EXPECT_GT(luminanceOf(glow), 10 * luminanceOf(seen(*sky, 3, 180, kSunsetSun)));
  }
  const Rgb zenith = seen(*sky, 90, 0, kSunsetSun);
  EXPECT_GT(zenith[2], 1.5 * zenith[0]);
}

// Interpolation between the rays of the table: 1 %. Rounding to nine bits of the largest channel: 1.3 % of red overhead.
TEST(SkyPicture, HasTheRadianceOfTheAtmosphere) {
  const auto sky = skyPicture("day");
  const Atmosphere air(0.06, 0.08);
  const auto exact = [&](const Double3& to) {
    const double apart = dotOf(to, kDaySun);
    const auto found = air.gather(to.y, kDaySun.y, apart);
    Spectrum sum;
    for (size_t b = 0; b < kBandCount; ++b)
      sum[b] = Atmosphere::rayleighPhase(apart) * found.rayleigh[b] + Atmosphere::miePhase(apart) * found.mie[b] + found.multiple[b];
    return sunColor(sum);
  };
  const Rgb top = seen(*sky, 90, 0, kDaySun);
  const Double3 overhead = exact({0, 1, 0});
  for (const double elevation : {0.7, 3.0, 15.0, 40.0, 70.0})
    for (const double turn : {5.0, 93.0, 170.0}) {
      const Double3 color = exact(towards(elevation, turn, kDaySun));
      const Rgb found = seen(*sky, elevation, turn, kDaySun);
      for (size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c] / top[c], color[c] / overhead[c], 0.04 * color[c] / overhead[c]) << elevation << " " << turn;
    }
}

// The sky itself and the sun, mirrored in 20,000 random slopes of the variance after Cox and Munk for a wind of 4 m/s. Of the sun a wide
// disc, whose light is the same.
TEST(SkyPicture, SeaMirrorsTheSkyInItsWaves) {
  const auto sky = skyPicture("day");
  const auto sun = findSun(*sky);
  std::mt19937 random(7);
  std::normal_distribution<double> slope(0, std::sqrt(0.0235 / 2));
  const double discCosine = std::cos(4 / kRadian), disc = 2 * std::numbers::pi * (1 - discCosine);
  const Rgb level = irradianceOf(*sky, {0, 1, 0}), below = {0.004, 0.016, 0.030};
  const Rgb light = {sun->light.x, sun->light.y, sun->light.z};
  for (const double down : {8.0, 20.0, 45.0, 80.0})
    for (const double turn : {0.0, 90.0, 170.0}) {
      const Double3 sight = towards(-down, turn, kDaySun);
      Rgb sum = {};
      double weights = 0;
      for (int k = 0; k < 20000; ++k) {
        const Double3 normal = unitOf({slope(random), 1, slope(random)});
        const double cosine = -dotOf(normal, sight);
        if (cosine <= 0) continue;
        const double weight = cosine / normal.y, reflectance = 0.02 + 0.98 * std::pow(1 - cosine, 5);
        const Double3 to = {sight.x + 2 * cosine * normal.x, std::abs(sight.y + 2 * cosine * normal.y), sight.z + 2 * cosine * normal.z};
        const double apart = dotOf(to, kDaySun);
        const Rgb around = apart > std::cos(1.5 / kRadian) ? Rgb{1, 1, 1} : skyAlong(*sky, to);
        for (size_t c = 0; c < 3; ++c)
          sum[c] += weight * reflectance * (around[c] + (apart > discCosine ? light[c] * std::numbers::pi / disc : 0));
        weights += weight;
      }
      const Rgb found = seen(*sky, -down, turn, kDaySun);
      for (size_t c = 0; c < 3; ++c) {
        const double expected = sum[c] / weights + below[c] * level[c] / std::numbers::pi;
        EXPECT_NEAR(found[c], expected, 0.12 * expected) << down << " below the horizon, " << turn << " from the sun, channel " << c;
      }
    }
}

TEST(SkyPicture, HorizonIsAnEdge) {
  const auto sky = skyPicture("day");
  for (const double turn : {60.0, 120.0, 180.0})
    EXPECT_LT(luminanceOf(seen(*sky, -0.3, turn, kDaySun)), 0.7 * luminanceOf(seen(*sky, 0.3, turn, kDaySun))) << turn;
}

}  // namespace environment_test
}  // namespace rill::test
