// Samples of film effects: no device needed.
#include "offline/film.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "views/scenery.hpp"

namespace rill::offline {
namespace film_test {

TEST(Film, OneSampleIsTheMiddle) {
  const FilmSample only = filmSample(0, 1);
  for (const double value : {only.x, only.y, only.time, only.lensX, only.lensY}) EXPECT_EQ(value, 0);
}

TEST(Film, SamplesAreSpreadEvenlyAroundTheMiddle) {
  for (const uint32_t count : {2u, 16u, 32u, 256u}) {
    double x = 0, y = 0, u = 0, v = 0, square = 0;
    std::vector<bool> instants(count);
    for (uint32_t k = 0; k < count; ++k) {
      const FilmSample sample = filmSample(k, count);
      x += sample.x, y += sample.y, u += sample.lensX, v += sample.lensY;
      square += (sample.lensX * sample.lensX + sample.lensY * sample.lensY) / count;
      EXPECT_LE(std::hypot(sample.lensX, sample.lensY), 1.2);
      EXPECT_LE(std::max(std::abs(sample.x), std::abs(sample.y)), 0.6);
      const double instant = (sample.time + 0.5) * count;
      EXPECT_NEAR(instant - std::floor(instant), 0.5, 1e-9) << "the middle of its part of the time";
      instants[size_t(instant)] = true;
    }
    for (const double sum : {x, y, u, v}) EXPECT_NEAR(sum, 0, 1e-9) << count;
    for (const bool taken : instants) EXPECT_TRUE(taken) << "each part of the time has a sample";
    EXPECT_NEAR(square, 0.5, count < 16 ? 0.5 : 0.03) << "as that of a full disc";
  }
}

// A discrepancy over boxes: the share of samples differs little from the share of the area.
TEST(Film, PixelsAreCoveredMoreEvenlyThanByChance) {
  constexpr uint32_t kCount = 64;
  double worst = 0;
  for (double right = 0.125; right <= 1; right += 0.125)
    for (double down = 0.125; down <= 1; down += 0.125) {
      int inside = 0;
      for (uint32_t k = 0; k < kCount; ++k) {
        const FilmSample sample = filmSample(k, kCount);
        inside += sample.x + 0.5 < right && sample.y + 0.5 < down ? 1 : 0;
      }
      worst = std::max(worst, std::abs(double(inside) / kCount - right * down));
    }
  EXPECT_LT(worst, 0.06) << "random points: about 0.12";
}

// Correlation of the parts would draw blur along lines.
TEST(Film, EffectsAreNotCorrelated) {
  constexpr uint32_t kCount = 64;
  double products[6] = {};
  for (uint32_t k = 0; k < kCount; ++k) {
    const FilmSample s = filmSample(k, kCount);
    const double pairs[6] = {s.time * s.x, s.time * s.y, s.time * s.lensX, s.time * s.lensY, s.x * s.lensX, s.y * s.lensY};
    for (size_t p = 0; p < 6; ++p) products[p] += pairs[p] / kCount;
  }
  const double deviation = std::sqrt(1.0 / 12);  // of time and pixels; 1/2 of the lens
  const double scale[6] = {deviation * deviation, deviation * deviation, deviation / 2, deviation / 2, deviation / 2, deviation / 2};
  for (size_t p = 0; p < 6; ++p) EXPECT_LT(std::abs(products[p]), 0.25 * scale[p]) << p;
}

TEST(Film, EffectsWithoutACountHaveTheDefault) {
  EXPECT_EQ(sampleCount({}), 1u);
  EXPECT_EQ(sampleCount({.samples = 7}), 7u);
  EXPECT_EQ(sampleCount({.shutter_s = 0.01}), kFilmSamples);
  EXPECT_EQ(sampleCount({.aperture = 2.8}), kFilmSamples);
  EXPECT_EQ(sampleCount({.samples = 9, .aperture = 2.8}), 9u);
}

TEST(Film, RejectsValuesOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(checkFilm({}));
  EXPECT_TRUE(checkFilm({.samples = 256, .shutter_s = 1000, .aperture = 0.5, .focus_m = 1e6}));
  for (const Film& film :
       {Film{.samples = 257}, Film{.shutter_s = -1}, Film{.shutter_s = nan}, Film{.shutter_s = 1001}, Film{.aperture = 0.4},
        Film{.aperture = 65}, Film{.aperture = nan}, Film{.focus_m = -1}, Film{.focus_m = 1e-4}, Film{.focus_m = nan}}) {
    const auto refused = checkFilm(film);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
    EXPECT_NE(refused.error().message.find("Options::film."), std::string::npos) << refused.error().message;
    EXPECT_NE(refused.error().message.find("; expected "), std::string::npos) << refused.error().message;
  }
}

/// Where a point is in the picture, pixels.
std::pair<double, double> seen(const FluidView& view, const Double3& point) {
  double at[3] = {0, 0, 0};
  for (int c = 0; c < 3; ++c) {
    const Float4& column = view.view.column[c];
    const double d = point[c] - view.origin[c];
    at[0] += column.x * d, at[1] += column.y * d, at[2] += column.z * d;
  }
  const auto& p = view.projection.column;
  const double w = -at[2];
  return {0.5 * view.width * (1 + (p[0].x * at[0] + p[2].x * at[2]) / w), 0.5 * view.height * (1 + (p[1].y * at[1] + p[2].y * at[2]) / w)};
}

TEST(Film, PixelOffsetMovesThePictureByIt) {
  const CameraView camera{.eye = {1, 2, 5}, .target = {0.3, 1, 0}, .fov_y_deg = 35};
  const Double3 point = {0.5, 0.7, 1.5};
  const auto before = seen(fluidView(camera, 640, 360, 0.01), point);
  const auto after = seen(fluidView(camera, 640, 360, 0.01, {.x_px = 0.25, .y_px = -0.4}), point);
  EXPECT_NEAR(after.first, before.first - 0.25, 1e-3);
  EXPECT_NEAR(after.second, before.second + 0.4, 1e-3);
}

// Against the formula of a thin lens: c = A |d - s| / d * f / (s - f), on a sensor 24 mm high.
TEST(Film, LensBlursByTheCircleOfConfusion) {
  const CameraView camera{.eye = {0, 0, 4}, .target = {0, 0, 0}, .fov_y_deg = 30};
  constexpr uint32_t kHeight = 360;
  const double focus = 2.5;
  const Film film{.aperture = 1.4, .focus_m = focus};
  const double image = 0.012 / std::tan(15 * std::numbers::pi / 180), focal = 1 / (1 / image + 1 / focus);
  for (const double distance : {1.5, 2.5, 4.0, 20.0}) {
    const Double3 point = {0.1, 0.2, 4 - distance};
    const auto center = seen(fluidView(camera, 640, kHeight, 0.01), point);
    const double blur = focal / 1.4 * std::abs(distance - focus) / distance * focal / (focus - focal) / 0.024 * kHeight;
    for (const auto& [u, v] : {std::pair{1.0, 0.0}, std::pair{0.0, 1.0}, std::pair{-0.6, 0.8}}) {
      const CameraOffset offset = cameraOffset(film, {.lensX = u, .lensY = v}, camera);
      const auto moved = seen(fluidView(camera, 640, kHeight, 0.01, offset), point);
      EXPECT_NEAR(2 * std::hypot(moved.first - center.first, moved.second - center.second), blur, 0.001 * blur + 0.002) << distance;
    }
  }
  EXPECT_DOUBLE_EQ(cameraOffset({.aperture = 2}, {}, camera).focus_m, 4) << "by default the camera's target";
}

}  // namespace film_test
}  // namespace rill::offline
