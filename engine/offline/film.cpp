#include "offline/film.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/words.hpp"

namespace rill::offline {
namespace {

constexpr double kSensorHeight = 0.024;  // m, full frame

Expected<void> checkRange(const char* what, double value, double low, double high, bool zero) {
  if ((zero && value == 0) || (value >= low && value <= high)) return {};
  return Error{ErrorKind::BadInput, "Options::film." + std::string(what) + " is " + shortestNumber(value) + "; expected " +
                                        (zero && low > 0 ? "0 or " : "") + "a number from " + shortestNumber(low) + " to " +
                                        shortestNumber(high)};
}

/// Where `k` goes in a fixed shuffle of `count` numbers (Fisher and Yates, random numbers by Knuth's MMIX generator).
uint32_t shuffled(uint32_t k, uint32_t count, uint64_t seed) {
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (uint32_t left = count; left > 1; --left) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    std::swap(order[left - 1], order[(seed >> 33) % left]);
  }
  return order[k];
}

double fraction(double value) { return value - std::floor(value); }

struct Pair {
  double x, y;
};

/// The sequence R2 (Roberts 2018), within a unit square around 0.
Pair inPixel(uint32_t k) {
  constexpr double kPlastic = 1.32471795724474602596;
  return {fraction(k / kPlastic) - 0.5, fraction(k / (kPlastic * kPlastic)) - 0.5};
}

/// A spiral by the golden angle (Vogel 1979), which fills the disc evenly.
Pair inDisc(uint32_t k, uint32_t count) {
  const double radius = std::sqrt((k + 0.5) / count), angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Point k of `count`, less the mean of all: the picture as a whole stays where it is.
template <class Point>
Pair centered(uint32_t k, uint32_t count, Point&& point) {
  Pair mean{0, 0};
  for (uint32_t i = 0; i < count; ++i) mean.x += point(i).x / count, mean.y += point(i).y / count;
  return {point(k).x - mean.x, point(k).y - mean.y};
}

}  // namespace

Expected<void> checkFilm(const Film& film) {
  if (film.samples > kMaxFilmSamples)
    return Error{ErrorKind::BadInput, "Options::film.samples is " + std::to_string(film.samples) + "; expected a number from 0 to " +
                                          std::to_string(kMaxFilmSamples)};
  if (auto valid = checkRange("shutter_s", film.shutter_s, 0, kMaxShutter_s, false); !valid) return valid;
  if (auto valid = checkRange("aperture", film.aperture, kMinAperture, kMaxAperture, true); !valid) return valid;
  return checkRange("focus_m", film.focus_m, kMinFocus_m, kMaxFocus_m, true);
}

uint32_t sampleCount(const Film& film) {
  if (film.samples > 0) return film.samples;
  return film.shutter_s > 0 || film.aperture > 0 ? kFilmSamples : 1;
}

FilmSample filmSample(uint32_t k, uint32_t count) {
  const Pair pixel = centered(k, count, inPixel);
  const uint32_t instant = shuffled(k, count, 1), place = shuffled(k, count, 2);
  const Pair lens = centered(place, count, [count](uint32_t i) { return inDisc(i, count); });
  return {.x = pixel.x, .y = pixel.y, .time = (instant + 0.5) / count - 0.5, .lensX = lens.x, .lensY = lens.y};
}

double lensRadius(double aperture, double fov_y_deg, double focus_m) {
  // The image of the focus lies behind the lens by `image`; the focal length follows from both distances.
  const double image = 0.5 * kSensorHeight / std::tan(0.5 * fov_y_deg * std::numbers::pi / 180);
  const double focal = image * focus_m / (image + focus_m);
  return 0.5 * focal / aperture;
}

CameraOffset cameraOffset(const Film& film, const FilmSample& sample, const CameraView& camera) {
  CameraOffset offset{.x_px = sample.x, .y_px = sample.y};
  if (!(film.aperture > 0)) return offset;
  double distance = film.focus_m;
  if (!(distance > 0))
    distance = std::hypot(camera.target[0] - camera.eye[0], camera.target[1] - camera.eye[1], camera.target[2] - camera.eye[2]);
  offset.focus_m = std::clamp(distance, kMinFocus_m, kMaxFocus_m);
  const double radius = lensRadius(film.aperture, camera.fov_y_deg, offset.focus_m);
  offset.right_m = radius * sample.lensX;
  offset.up_m = radius * sample.lensY;
  return offset;
}

}  // namespace rill::offline
