// Built-in skies.
#include <gtest/gtest.h>

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
const Double3 kDaySun = unitOf({-0.36, 1.0, 0.52}), kSunsetSun = unitOf({-0.75, 0.105, -0.66});

Double3 towards(double elevation, double turn, const Double3& sun) {
  const double azimuth = std::atan2(sun.z, sun.x) + turn / kRadian, level = std::cos(elevation / kRadian);
  return {level * std::cos(azimuth), std::sin(elevation / kRadian), level * std::sin(azimuth)};
}

/// The texel in the direction that is `turn` degrees away from the sun's azimuth.
Rgb seen(const EnvironmentPicture& sky, double elevation, double turn, const Double3& sun) {
  const Double3 to = towards(elevation, turn, sun);
  const auto row = uint32_t(std::acos(to.y) / std::numbers::pi * sky.height);
  const auto column = uint32_t((std::atan2(to.x, -to.z) / (2 * std::numbers::pi) + 0.5) * sky.width) % sky.width;
  return unpacked(sky.texels[row * sky.width + column]);
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
  for (const double channel : white) EXPECT_NEAR(channel / std::numbers::pi, 2.1, 0.015) << "white ground is white by day";
  EXPECT_NEAR(luminanceOf(evening) / std::numbers::pi, 0.45, 0.005);
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
      EXPECT_NEAR(aboveDaylight(seen(*sky, elevation, turn, kDaySun)), 0.003, 0.005) << elevation << " " << turn;
    }
    const Rgb low = seen(*sky, 1, turn, kDaySun);
    EXPECT_GT(luminanceOf(low), 1.3 * luminanceOf(zenith)) << turn;
    EXPECT_LT(low[2], 1.5 * low[0]) << "white at " << turn;
    EXPECT_LT(luminanceOf(seen(*sky, 20, turn, kDaySun)), luminanceOf(low)) << turn;
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

// Interpolation between the rays of the table, and rounding to nine bits: 1 % each.
TEST(SkyPicture, HasTheRadianceOfTheAtmosphere) {
  const auto sky = skyPicture("day");
  const Atmosphere air(0.09, 0.2421);
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
        EXPECT_NEAR(found[c] / top[c], color[c] / overhead[c], 0.03 * color[c] / overhead[c]) << elevation << " " << turn;
    }
}

}  // namespace environment_test
}  // namespace rill::test
