// Theory of waves against limits, quadratures and equations that are solved otherwise.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "bench/experiments/waves.hpp"

namespace rill::bench {
namespace wave_theory_test {

constexpr double kPi = std::numbers::pi;

TEST(WaveTheory, DispersionHasDeepAndShallowLimits) {
  const StandingWave deep{.length_m = 1, .depth_m = 5, .mode = 3}, shallow{.length_m = 1, .depth_m = 0.01, .mode = 1};
  EXPECT_NEAR(deep.waveNumber(), 3 * kPi, 1e-12);
  EXPECT_NEAR(deep.frequency(), std::sqrt(9.81 * 3 * kPi), 1e-9);
  EXPECT_NEAR(shallow.frequency(), kPi * std::sqrt(9.81 * 0.01), 1e-3 * kPi * std::sqrt(9.81 * 0.01));
}

TEST(WaveTheory, PeriodsMatchTable) {
  std::ifstream file(std::filesystem::path(RILL_SOURCE_DIR) / "assets" / "validation" / "sloshing_first_mode.csv");
  std::string line;
  std::getline(file, line);
  int rows = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    double length = 0, depth = 0, period = 0;
    char comma = 0;
    ASSERT_TRUE(cells >> length >> comma >> depth >> comma >> period);
    EXPECT_NEAR((StandingWave{.length_m = length, .depth_m = depth}.period()), period, 1e-5);
    ++rows;
  }
  EXPECT_EQ(rows, 3);
}

TEST(WaveTheory, SecondOrderLowersFrequencyInDeepWaterOnly) {
  StandingWave wave{.length_m = kPi, .depth_m = 20, .amplitude_m = 0.2};  // k = 1
  EXPECT_NEAR(wave.secondOrder(), -0.2 * 0.2 / 8, 1e-9) << "Rayleigh 1915: 1 - (k a)^2 / 8";
  wave.depth_m = 1.0581;  // the critical depth
  EXPECT_NEAR(wave.secondOrder(), 0, 1e-5);
  wave.depth_m = 0.5;
  EXPECT_GT(wave.secondOrder(), 0.01);
}

TEST(WaveTheory, ViscousDecayMatchesDissipation) {
  // Dissipation of the potential flow cos(k x) cosh(k y) by quadrature: mu times the integral of 2 e_ij e_ij.
  constexpr double kWave = 3, kDepth = 0.4, kViscosity = 0.01;
  double dissipated = 0, kinetic = 0;
  constexpr int kCells = 400;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const double x = (i + 0.5) / kCells * 2 * kPi / kWave, y = (j + 0.5) / kCells * kDepth;
      const double c = std::cos(kWave * x), s = std::sin(kWave * x), ch = std::cosh(kWave * y), sh = std::sinh(kWave * y);
      const double exx = -kWave * kWave * c * ch, exy = -kWave * kWave * s * sh;
      dissipated += 2 * kViscosity * (2 * exx * exx + 2 * exy * exy);
      kinetic += 0.5 * kWave * kWave * (s * s * ch * ch + c * c * sh * sh);
    }
  // Half of the energy is kinetic in the mean, and the energy goes as the amplitude's square.
  const double rate = dissipated / (2 * kinetic) / 2, veryFast = 1e9;
  EXPECT_NEAR(viscousDecay(kViscosity, kWave, veryFast), rate, 1e-4 * rate);
}

TEST(WaveTheory, ViscousDecaySolvesDeepWaterEquation) {
  // Lamb, section 349, in units of omega: (n + 2 r)^2 + 1 = 4 r^2 sqrt(1 + n / r) with r = nu k^2, by fixed-point iteration.
  for (const double r : {0.001, 0.01, 0.06}) {
    std::complex<double> n(0, 1);
    for (int step = 0; step < 200; ++step) n = std::complex<double>(0, 1) * std::sqrt(1.0 - 4 * r * r * std::sqrt(1.0 + n / r)) - 2 * r;
    EXPECT_NEAR(viscousDecay(r, 1, 1), -n.real(), 0.02 * 2 * r) << r;
    EXPECT_LT(viscousDecay(r, 1, 1), 2 * r);
  }
}

TEST(WaveTheory, SolitaryWaveKeepsMass) {
  const SolitaryWave wave{.depth_m = 0.2, .height_m = 0.06};
  EXPECT_NEAR(wave.speed(), std::sqrt(9.81 * 0.26), 1e-12);
  EXPECT_NEAR(wave.elevation(0), 0.06, 1e-12);
  EXPECT_NEAR(wave.crossSection(-10, 10), 4 * 0.06 / std::sqrt(3 * 0.06 / (0.2 * 0.2 * 0.2)) * 1, 1e-9);
  for (const double x : {-0.3, 0.0, 0.1, 0.5}) {
    constexpr double kStep = 1e-5;
    // The discharge through a section that moves with the wave is that of the fluid at rest.
    EXPECT_NEAR((wave.speed() - wave.velocity(x)) * (0.2 + wave.elevation(x)), wave.speed() * 0.2, 1e-12);
    EXPECT_NEAR(wave.stretching(x), -(wave.velocity(x + kStep) - wave.velocity(x - kStep)) / (2 * kStep), 1e-6);
    EXPECT_NEAR((wave.crossSection(0, x + kStep) - wave.crossSection(0, x - kStep)) / (2 * kStep), wave.elevation(x), 1e-8);
  }
}

TEST(WaveTheory, LevelShiftIsCenterOfMassOfWedge) {
  constexpr double kLength = 2, kDepth = 0.4, kSlope = 0.01;
  double moment = 0, volume = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = (i + 0.5) / 1000 * kLength, height = kDepth + kSlope * (x - kLength / 2);
    moment += x * height;
    volume += height;
  }
  EXPECT_NEAR(levelShift(kLength, kDepth, kSlope), moment / volume - kLength / 2, 1e-7);
}

}  // namespace wave_theory_test
}  // namespace rill::bench
