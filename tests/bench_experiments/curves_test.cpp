#include "bench/experiments/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "bench/experiments/exact.hpp"

namespace rill::bench {
namespace {

const std::filesystem::path kPublished = std::filesystem::path(RILL_SOURCE_DIR) / "assets" / "validation";

TEST(Curves, InterpolatesLinearlyAndClamps) {
  const Curve curve{{0, 1}, {1, 3}, {3, 3}};
  EXPECT_EQ(at(curve, -1), 1);
  EXPECT_EQ(at(curve, 0.5), 2);
  EXPECT_EQ(at(curve, 2), 3);
  EXPECT_EQ(at(curve, 9), 3);
}

TEST(Curves, FitShiftFindsLagOfPoints) {
  Curve curve, points;
  for (double x = 0; x < 6; x += 0.01) curve.emplace_back(x, 1 + x * x);
  for (double x = 1; x < 4; x += 0.3) points.emplace_back(x + 0.137, 1 + x * x);
  const ShiftFit fit = fitShift(curve, points);
  EXPECT_NEAR(fit.shift, 0.137, 1e-4);
  EXPECT_LT(fit.shifted, 1e-4);
  EXPECT_GT(fit.unshifted, 0.05);
}

TEST(Curves, FitShiftKeepsErrorOfShape) {
  Curve curve, points;
  for (double x = 0; x < 6; x += 0.01) curve.emplace_back(x, 1 + 1.2 * x * x);
  for (double x = 1; x < 4; x += 0.3) points.emplace_back(x, 1 + x * x);
  const ShiftFit fit = fitShift(curve, points);
  EXPECT_LT(fit.shifted, fit.unshifted);
  EXPECT_GT(fit.shifted, 0.01);
}

TEST(Curves, ZeroCrossingsAreInterpolated) {
  const Curve curve{{0, 4}, {1, 2}, {2, -2}, {3, 2}};
  EXPECT_EQ(zeroCrossings(curve, 0, 0), (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(zeroCrossings(curve, 1, 0), (std::vector<double>{1.25, 2.75}));
  EXPECT_EQ(zeroCrossings(curve, 0, 1.1), (std::vector<double>{2.5}));
  EXPECT_TRUE(zeroCrossings(curve, 5, 0).empty());
  EXPECT_TRUE(zeroCrossings({}, 0, 0).empty());
}

TEST(Curves, OscillationMeasuresPeriodAndDamping) {
  constexpr double kPeriod = 1.18, kDecrement = 0.2;
  Curve curve;
  for (int k = 0; k < 400; ++k) {
    const double t = k / 60.0;
    curve.emplace_back(t, 0.02 * std::exp(-kDecrement * t / kPeriod) * std::cos(2 * std::numbers::pi * t / kPeriod));
  }
  const Oscillation found = oscillation(curve, 0);
  EXPECT_NEAR(found.period, kPeriod, 1e-3 * kPeriod);
  EXPECT_NEAR(found.decrement, kDecrement, 0.01 * kDecrement);
  EXPECT_GE(found.peaks.size(), 9u);
}

TEST(Curves, OscillationIgnoresNoiseAfterDecay) {
  Curve curve;
  for (int k = 0; k < 600; ++k) {
    const double t = k / 60.0;
    curve.emplace_back(t, t < 4.75 ? std::cos(2 * std::numbers::pi * t) : (k % 2 ? 0.001 : -0.001));
  }
  EXPECT_NEAR(oscillation(curve, 0).period, 1, 0.01);
}

TEST(Curves, OscillationWithoutCrossingsHasNoPeriod) { EXPECT_TRUE(std::isnan(oscillation({{0, 1}, {1, 0.5}, {2, -0.1}}, 0).period)); }

TEST(Curves, ReadsPublishedFiles) {
  for (const char* name : {"martin_moyce_n2_1_front", "martin_moyce_n2_2_front", "martin_moyce_n2_1_height", "martin_moyce_n2_2_height"}) {
    const auto curve = readCurve(kPublished / (std::string(name) + ".csv"));
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_GE(curve->size(), 6u);
  }
  EXPECT_FALSE(readCurve(kPublished / "nothing.csv"));
  EXPECT_FALSE(readCurve(kPublished / "README.md"));
}

TEST(Exact, EllipticDropMatchesTable) {
  const auto table = readCurve(kPublished / "elliptic_drop.csv");
  ASSERT_TRUE(table);
  for (const auto& [time, axis] : *table) {
    const EllipticDrop drop = ellipticDrop(time);
    EXPECT_NEAR(drop.b, axis, 6e-4) << time;  // the table's last digit
    EXPECT_NEAR(drop.a * drop.b, 1, 1e-9);
  }
}

}  // namespace
}  // namespace rill::bench
