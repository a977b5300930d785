#include "render/atmosphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/brute_force_sky.hpp"

namespace rill::test {
namespace atmosphere_test {

using brute_force_sky::Air;

constexpr double kDegree = std::numbers::pi / 180;
constexpr size_t kBlue = 1, kGreen = 4, kRed = 7;

/// Coefficients of a band by the formulas of the sources.
Air airOf(size_t band, double aerosolDepth, double groundAlbedo) {
  const double nm = kBands[band].nanometers;
  return {5.802e-3 * std::pow(680 / nm, 4), aerosolDepth / 1.2 * std::pow(550 / nm, 1.3),
          300 * 2.687e20 / 15e3 * kBands[band].ozone * 1e-25 * 1e3, groundAlbedo};
}

TEST(AtmosphereTest, VerticalPathFollowsTheProfiles) {
  for (const double aerosols : {0.0, 0.09, 0.4}) {
    const Atmosphere atmosphere(aerosols, 0.2);
    for (const size_t band : {kBlue, kGreen, kRed}) {
      const Air air = airOf(band, aerosols, 0.2);
      for (const double height : {0.0, 2.0, 50.0}) {
        const double molecules = 8 * (std::exp(-height / 8) - std::exp(-100.0 / 8));
        const double depth = air.rayleigh * molecules + air.aerosols * 1.2 * std::exp(-height / 1.2) + (height < 10 ? air.ozone * 15 : 0);
        EXPECT_NEAR(atmosphere.transmittance(height, 1)[band], std::exp(-depth), 0.003) << band << " from " << height << " km";
      }
    }
  }
}

TEST(AtmosphereTest, TransmittanceIsThatOfSlantedPaths) {
  const Atmosphere atmosphere(0.09, 0.2);
  for (const size_t band : {kBlue, kGreen, kRed})
    for (const double height : {0.0, 0.5, 10.0})
      for (const double cosine : {-0.03, 0.01, 0.1, 0.5}) {
        const Air air = airOf(band, 0.09, 0.2);
        const double exact = air.transmittance({0, 6360 + height, 0}, {std::sqrt(1 - cosine * cosine), cosine, 0});
        EXPECT_NEAR(atmosphere.transmittance(height, cosine)[band], exact, 0.003 + 0.02 * exact) << band << " " << height << " " << cosine;
      }
}

TEST(AtmosphereTest, PhaseFunctionsKeepEnergy) {
  constexpr int kSteps = 20000;
  double sums[2] = {}, aerosolMean = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double cosine = 2 * (k + 0.5) / kSteps - 1, solidAngle = 4 * std::numbers::pi / kSteps;
    sums[0] += Atmosphere::rayleighPhase(cosine) * solidAngle;
    sums[1] += Atmosphere::miePhase(cosine) * solidAngle;
    aerosolMean += Atmosphere::miePhase(cosine) * cosine * solidAngle;
  }
  EXPECT_NEAR(sums[0], 1, 1e-4);
  EXPECT_NEAR(sums[1], 1, 1e-4);
  // Cornette and Shanks (1992): g (12 + 3 g^2) / (5 (2 + g^2)) with g = 0.8
  EXPECT_NEAR(aerosolMean, 0.8 * (12 + 3 * 0.64) / (5 * 2.64), 1e-3);
}

// Higher orders are isotropic in the model, but for what aerosols scatter straight ahead.
TEST(AtmosphereTest, AgreesWithRandomPaths) {
  const Atmosphere atmosphere(0.09, 0.2);
  for (const double height : {39.0, 6.0}) {
    const Double3 sun = {std::cos(height * kDegree), std::sin(height * kDegree), 0};
    for (const size_t band : {kBlue, kRed})
      for (const double elevation : {90.0, 30.0, 10.0, 4.0, 1.0}) {
        const double up = std::sin(elevation * kDegree), level = std::cos(elevation * kDegree);
        const Double3 sight = {level * std::cos(120 * kDegree), up, level * std::sin(120 * kDegree)};
        const double apart = sight.x * sun.x + sight.y * sun.y;
        const auto found = atmosphere.gather(up, sun.y, apart);
        const double once = Atmosphere::rayleighPhase(apart) * found.rayleigh[band] + Atmosphere::miePhase(apart) * found.mie[band];
        const auto expected = brute_force_sky::radiance(airOf(band, 0.09, 0.2), sight, sun, 20000);
        EXPECT_NEAR((once + found.multiple[band]) / expected.all, 1, elevation > 2 ? 0.14 : 0.22)
            << band << " at " << elevation << ", sun at " << height;
      }
  }
}

// Without aerosols nothing is scattered straight ahead, and one order is that of random paths.
TEST(AtmosphereTest, FirstOrderOfMoleculesAgreesWithRandomPaths) {
  const Double3 sun = {std::cos(58 * kDegree), std::sin(58 * kDegree), 0};
  const Atmosphere atmosphere(0, 0.2);
  for (const size_t band : {kBlue, kRed})
    for (const double elevation : {90.0, 30.0, 3.0}) {
      const double up = std::sin(elevation * kDegree), level = std::cos(elevation * kDegree);
      const Double3 sight = {level * std::cos(120 * kDegree), up, level * std::sin(120 * kDegree)};
      const double apart = sight.x * sun.x + sight.y * sun.y;
      const auto found = atmosphere.gather(up, sun.y, apart);
      const auto expected = brute_force_sky::radiance(airOf(band, 0, 0.2), sight, sun, 10000);
      EXPECT_NEAR(Atmosphere::rayleighPhase(apart) * found.rayleigh[band] / expected.once, 1, 0.04) << band << " at " << elevation;
    }
}

TEST(AtmosphereTest, GroundSendsItsLightBack) {
  const Atmosphere black(0.09, 0), white(0.09, 0.8);
  EXPECT_GT(white.multiple(0, 0.85)[kBlue], 1.5 * black.multiple(0, 0.85)[kBlue]);
  EXPECT_EQ(white.transmittance(0, 0.85), black.transmittance(0, 0.85));
}

TEST(AtmosphereTest, LitByNothingAtNight) {
  const Atmosphere atmosphere(0.09, 0.2);
  EXPECT_EQ(atmosphere.transmittance(0, -0.2)[kRed], 0);
  EXPECT_LT(atmosphere.multiple(0, -0.5)[kRed], 1e-3 * atmosphere.multiple(0, 0.5)[kRed]);
}

// Clear skies of the IES (Gillette, Pierpoint and Treado 1984): 127.5 klx exp(-0.21 m) from the sun at the air mass m, and
// 0.8 klx + 15.5 klx sin^0.5 of its height from the sky on level ground.
TEST(AtmosphereTest, IlluminancesAreThoseOfClearDays) {
  const Atmosphere atmosphere(0.09, 0.2);
  for (const double degrees : {30.0, 45.0, 58.0}) {
    const double sine = std::sin(degrees * kDegree), cosine = std::cos(degrees * kDegree);
    const Double3 direct = sunColor(atmosphere.transmittance(0, sine));
    double sky = 0;
    constexpr int kRows = 30, kColumns = 60;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        const double up = std::sqrt((row + 0.5) / kRows), turn = 2 * std::numbers::pi * (column + 0.5) / kColumns;
        const double apart = up * sine + std::sqrt(1 - up * up) * cosine * std::cos(turn);
        const auto light = atmosphere.gather(up, sine, apart);
        const Double3 molecules = sunColor(light.rayleigh), aerosols = sunColor(light.mie), more = sunColor(light.multiple);
        const auto luminance = [](const Double3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; };
        sky +=
            std::numbers::pi / (kRows * kColumns) *
            (Atmosphere::rayleighPhase(apart) * luminance(molecules) + Atmosphere::miePhase(apart) * luminance(aerosols) + luminance(more));
      }
    const double found = 0.2126 * direct.x + 0.7152 * direct.y + 0.0722 * direct.z;
    EXPECT_NEAR(127.5 * found, 127.5 * std::exp(-0.21 / sine), 0.05 * 127.5) << degrees;
    // The light of the sky on clear days differs by this much from place to place.
    EXPECT_NEAR(127.5 * sky, 0.8 + 15.5 * std::sqrt(sine), 0.25 * 15) << degrees;
  }
}

}  // namespace atmosphere_test
}  // namespace rill::test
