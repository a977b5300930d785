#include "bench/experiments/waves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "bench/experiments/bands.hpp"
#include "bench/experiments/wave_starts.hpp"

namespace rill::bench {
namespace {

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

TEST(WaveSuite, TanksHaveWholeSpacingsAndSmallWaves) {
  for (int mode = 1; mode <= 3; ++mode)
    for (unsigned level = 0; level < kLevels; ++level)
      for (const WaveTank& tank : {deepTank(mode, level), shallowTank(mode, level)}) {
        const double layers = tank.wave.depth_m / tank.spacing_m, columns = tank.wave.length_m / tank.spacing_m;
        EXPECT_NEAR(layers, std::round(layers), 1e-9);
        EXPECT_NEAR(columns, std::round(columns), 1e-9);
        const double particles = layers * columns * tank.thickness;
        EXPECT_GE(particles, 5000);
        EXPECT_LE(particles, 40000);
        EXPECT_LT(std::abs(tank.wave.secondOrder()), 0.006);
      }
  EXPECT_GT(std::tanh(deepTank(2, 0).wave.waveNumber() * deepTank(2, 0).wave.depth_m), 0.998);
  EXPECT_NEAR(shallowTank(1, 2).wave.waveNumber() * shallowTank(1, 2).wave.depth_m, 0.5, 0.02);
}

TEST(WaveSuite, SettingsAreSceneKeys) {
  for (const WaveSetting& setting : comparedSettings()) {
    const auto scene = waveSettings(setting.changes);
    EXPECT_TRUE(scene) << setting.name << ": " << scene.error().message;
  }
  const auto changed = waveSettings("fluid.smoothing_ratio=2.4 solver.neighbors=grid");
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->fluid.smoothing_ratio, 2.4);
  EXPECT_EQ(changed->solver.neighbors, NeighborChoice::Grid);
  EXPECT_FALSE(waveSettings("fluid.smothing_ratio=2.3"));
}

TEST(WaveSuite, SettingCostIsThatOfOnePeriodAfterStart) {
  const double period = deepTank(1, 0).wave.period();
  RunFigures run;
  for (int k = 0; k <= 150; ++k) {
    const double time = k / 60.0;
    run.instants.push_back({time, {}});
    run.instants.back().stats.wall_s = time < 0.11 || time > 0.1 + period ? 100 : 0.05;
  }
  EXPECT_NEAR(settingCost(run), 3, 1e-9);
  run.instants.resize(60);
  EXPECT_TRUE(std::isnan(settingCost(run)));
}

TEST(WaveSuite, FiguresHaveRowsOfBands) {
  for (const char* family : {"deep-mode-1", "shallow-mode-3", "viscosity-0.1", "setting h 2"})
    for (const char* figure : {"period", "loss a period"}) EXPECT_NE(bandOf(family, figure), nullptr) << family << ", " << figure;
  EXPECT_NE(bandOf("viscosity-0", "decay"), nullptr);
  for (const char* figure : {"speed", "speed at its height", "height kept"}) EXPECT_NE(bandOf("solitary-8", figure), nullptr) << figure;
  EXPECT_NE(bandOf("level-0.3", "shift"), nullptr);
}

}  // namespace
}  // namespace rill::bench
