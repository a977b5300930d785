// Initial states of waves, and what is measured of particles: modes, damped cosines, surfaces, crests.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "bench/experiments/wave_starts.hpp"
#include "bench/experiments/waves.hpp"

namespace rill::bench {
namespace wave_measures_test {

constexpr double kPi = std::numbers::pi;

/// Particles on a lattice whose columns are compressed so that the surface is depth + height(x).
template <class Height>
Cloud raisedColumns(double length, double depth, double spacing, const Height& height) {
  Cloud cloud;
  cloud.spacing = spacing;
  // Volume up to x, to place particles of equal volume.
  const int columns = static_cast<int>(std::lround(length / spacing)), layers = static_cast<int>(std::lround(depth / spacing));
  double x = 0;
  for (int i = 0; i < columns; ++i) {
    double left = depth * spacing, center = x;
    for (constexpr double kStep = 1e-5; left > 0; x += kStep) {
      left -= kStep * (depth + height(x));
      if (left > depth * spacing / 2) center = x;
    }
    for (int j = 0; j < layers; ++j) {
      cloud.position.push_back({center, (j + 0.5) * spacing, spacing / 2});
      cloud.velocity.push_back({0, 0, 0});
    }
  }
  return cloud;
}

// The same particles a quarter of a period later, by linear theory.
Cloud atItsHighest(const StandingWave& wave, double spacing, int thickness) {
  Cloud cloud = standingWave(wave, spacing, thickness);
  for (size_t i = 0; i < cloud.size(); ++i)
    for (size_t axis : {0, 1}) cloud.position[i][axis] += cloud.velocity[i][axis] / wave.frequency();
  return cloud;
}

TEST(WaveStarts, StandingWaveHasItsModeOnly) {
  for (const int mode : {1, 2, 3}) {
    const StandingWave wave{.length_m = 1, .depth_m = 0.3, .mode = mode, .amplitude_m = 0.005};
    const Cloud cloud = standingWave(wave, 0.02, 2);
    ASSERT_EQ(cloud.size(), 50u * 15 * 2);
    const Cloud highest = atItsHighest(wave, 0.02, 2);
    for (int other = 1; other <= 4; ++other) {
      EXPECT_NEAR(modalAmplitude(cloud, other * kPi, 0.3), 0, 1e-9) << mode << ", " << other;
      EXPECT_NEAR(modalAmplitude(highest, other * kPi, 0.3), other == mode ? 0.005 : 0, 2e-4) << mode << ", " << other;
    }
  }
}

TEST(WaveStarts, SolitaryWaveHasVolumeAndMomentumOfTheory) {
  const SolitaryWave wave{.depth_m = 0.2, .height_m = 0.06};
  const Cloud cloud = solitaryWave(wave, 4, 1.5, 0.025, 4);
  const double share = std::pow(0.025, 3) / 0.1;  // of a particle, per width of the tank
  EXPECT_NEAR(double(cloud.size()) * share, 4 * 0.2 + wave.crossSection(-1.5, 2.5), 0.02 * wave.crossSection(-1.5, 2.5));
  double momentum = 0, highest = 0;
  for (size_t i = 0; i < cloud.size(); ++i) {
    momentum += cloud.velocity[i][0] * share;
    highest = std::max(highest, cloud.position[i][1]);
  }
  EXPECT_NEAR(momentum, wave.speed() * wave.crossSection(-1.5, 2.5), 0.02 * momentum);
  EXPECT_NEAR(highest, 0.26, 0.02);
}

TEST(WaveMeasures, ModalAmplitudeIsThatOfTheSurface) {
  const Cloud cloud = raisedColumns(1, 0.2, 0.01, [](double x) { return 0.03 * std::cos(2 * kPi * x) + 0.01 * std::cos(kPi * x); });
  EXPECT_NEAR(modalAmplitude(cloud, 2 * kPi, 0.2), 0.03, 3e-4);
  EXPECT_NEAR(modalAmplitude(cloud, kPi, 0.2), 0.01, 3e-4);
  EXPECT_NEAR(modalAmplitude(cloud, 3 * kPi, 0.2), 0, 3e-4);
}

TEST(WaveMeasures, ModalAmplitudeIsRobustToNoise) {
  Cloud cloud = atItsHighest({.length_m = 1, .depth_m = 0.3, .amplitude_m = 0.02}, 0.02, 4);
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.01);  // half a spacing
  for (Double3& point : cloud.position)
    for (double& coordinate : point) coordinate += noise(random);
  EXPECT_NEAR(modalAmplitude(cloud, kPi, 0.3), 0.02, 4e-4);
}

Curve dampedCurve(double frequency, double decay, double offset, double noise) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0, noise);
  Curve curve;
  for (int k = 0; k < 300; ++k) {
    const double t = k / 60.0;
    curve.emplace_back(t, offset + std::exp(-decay * t) * std::cos(frequency * t) + (noise > 0 ? normal(random) : 0));
  }
  return curve;
}

TEST(WaveMeasures, FitFindsFrequencyDecayAndOffset) {
  for (const double frequency : {4.0, 5.0, 6.5})
    for (const double decay : {0.0, 0.2, 2.0}) {
      const DampedCosine fit = fitDampedCosine(dampedCurve(frequency, decay, 0.1, 0), 5);
      EXPECT_NEAR(fit.frequency, frequency, 1e-4);
      EXPECT_NEAR(fit.decay, decay, 1e-4);
      EXPECT_NEAR(fit.offset, 0.1, 1e-4);
      EXPECT_NEAR(fit.cosine, 1, 1e-3);
      EXPECT_LT(fit.residual, 1e-3);
      EXPECT_NEAR(fit.keptPerPeriod(), std::exp(-decay * 2 * kPi / frequency), 1e-4);
    }
}

TEST(WaveMeasures, FitIgnoresNoiseAndReportsIt) {
  const DampedCosine fit = fitDampedCosine(dampedCurve(5.4, 0.3, 0, 0.1), 5);
  EXPECT_NEAR(fit.frequency, 5.4, 0.03);
  EXPECT_NEAR(fit.decay, 0.3, 0.05);
  EXPECT_NEAR(fit.residual, 0.2, 0.1);
  EXPECT_TRUE(std::isnan(fitDampedCosine({{0, 1}, {1, 2}}, 5).frequency));
}

TEST(WaveMeasures, WindowMeanIgnoresSlosh) {
  for (const double phase : {0.0, 0.8, 1.6, 2.4}) {
    Curve curve;
    for (int k = 0; k < 600; ++k) curve.emplace_back(k / 60.0, 3 + std::cos(2 * kPi * k / 60.0 / 2 + phase));
    EXPECT_NEAR(windowMean(curve, 4, 8), 3, 1e-3) << "two periods";
    EXPECT_NEAR(windowMean(curve, 3.5, 8.5), 3, 0.03) << "two and a half; without the window 0.13";
  }
  EXPECT_TRUE(std::isnan(windowMean({{0, 1}, {1, 2}}, 20, 21)));
}

TEST(WaveMeasures, SmoothSurfaceIsDepthOfLattice) {
  const Cloud cloud = raisedColumns(2, 0.2, 0.02, [](double) { return 0.0; });
  const Curve surface = smoothSurface(cloud, {0.2, 1.8, 0.01, 0.4, 0.02});
  ASSERT_EQ(surface.size(), 161u);
  for (const auto& [x, height] : surface) EXPECT_NEAR(height, 0.2, 1e-3) << x;
}

TEST(CrestFollower, FollowsSmallerCrestPastLarger) {
  // A high crest stands at 3; the one that moves from 1 to 2 is lower.
  CrestFollower crest(1, 0.3);
  for (int k = 0; k <= 100; ++k) {
    Curve surface;
    for (double x = 0; x < 4; x += 0.02) {
      const double moving = std::cosh((x - 1 - 0.01 * k) / 0.2), standing = std::cosh((x - 3) / 0.05);
      surface.emplace_back(x, 0.1 / (moving * moving) + 0.3 / (standing * standing));
    }
    crest.follow(surface, 0.1 * k);
  }
  ASSERT_EQ(crest.positions().size(), 101u);
  EXPECT_NEAR(crest.positions().back().second, 2, 0.01);
  EXPECT_NEAR(slope(crest.positions()), 0.1, 1e-3);
  EXPECT_NEAR(crest.heights().back().second, 0.1, 0.015);
}

TEST(CrestFollower, MeasuresParticlesOfSolitaryWave) {
  const SolitaryWave wave{.depth_m = 0.2, .height_m = 0.06};
  CrestFollower crest(1.4, 0.1);
  for (int k = 0; k <= 10; ++k) {
    const Cloud cloud = solitaryWave(wave, 4, 1.5 + 0.027 * k, 0.02, 4);
    crest.follow(smoothSurface(cloud, {0.2, 3.8, 0.01, 0.4, 0.08}), k);
    EXPECT_NEAR(crest.positions().back().second, 1.5 + 0.027 * k, 0.01);
    EXPECT_NEAR(crest.heights().back().second, 0.258, 0.001) << "the window takes 3 % of the wave";
  }
}

}  // namespace wave_measures_test
}  // namespace rill::bench
