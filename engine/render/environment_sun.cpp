#include "render/environment_sun.hpp"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "core/vector_math.hpp"
#include "render/environment_texels.hpp"

namespace rill {
namespace {

constexpr double kMaxDisc_rad = 0.17;    // a brighter region that is larger is a window or a cloud
constexpr double kBrighterThanSky = 8;   // times the mean of the upper half: lowest radiance that counts as sun
constexpr double kDimmestOfDisc = 4e-3;  // times the brightest texel: rims and bloom
constexpr double kLeastLight = 0.1;      // of the sky's irradiance

struct SunRegion {
  std::vector<uint32_t> texels;  // indices
  Double3 around = {0, 0, 0};    // mean color of the texels next to it
  bool tooLarge = false;
};

/// Texels around `peak` that are brighter than `threshold`.
SunRegion growSun(const EnvironmentPicture& picture, uint32_t peak, double threshold) {
  const uint32_t width = picture.width, height = picture.height;
  const auto direction = [&](uint32_t at) { return mapDirection(at % width + 0.5, at / width + 0.5, width, height); };
  const Double3 center = direction(peak);
  const double farthest = std::cos(std::max(kMaxDisc_rad, 3 * std::numbers::pi / height));
  SunRegion region{{peak}, {0, 0, 0}, false};
  std::unordered_set<uint32_t> seen{peak};
  double beside = 0;
  for (size_t next = 0; next < region.texels.size(); ++next) {
    const uint32_t x = region.texels[next] % width, y = region.texels[next] / width;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const bool overPole = y == 0 && dy < 0;
        const uint32_t row = overPole ? 0 : std::min(y + static_cast<uint32_t>(dy), height - 1);
        const uint32_t column = (x + width + static_cast<uint32_t>(dx) + (overPole ? width / 2 : 0)) % width, at = row * width + column;
        if (!seen.insert(at).second) continue;
        const Double3 color = unpackTexel(picture.texels[at]);
        if (luminance(color) > threshold) {
          if (dot(direction(at), center) < farthest) {
            region.tooLarge = true;
            return region;
          }
          region.texels.push_back(at);
        } else {
          const double weight = texelSolidAngle(row, width, height);
          for (int c = 0; c < 3; ++c) region.around[c] += weight * color[c];
          beside += weight;
        }
      }
  }
  if (beside > 0)
    for (int c = 0; c < 3; ++c) region.around[c] /= beside;
  return region;
}

}  // namespace

std::optional<EnvironmentSun> takeSun(EnvironmentPicture& picture) {
  const uint32_t width = picture.width, height = picture.height, upper = height / 2;
  uint32_t peak = 0;
  double brightest = 0, sky = 0;
  for (uint32_t y = 0; y < upper; ++y) {
    double row = 0;
    for (uint32_t x = 0; x < width; ++x) {
      const double light = luminance(unpackTexel(picture.texels[size_t{y} * width + x]));
      row += light;
      if (light > brightest) {
        brightest = light;
        peak = y * width + x;
      }
    }
    sky += row * texelSolidAngle(y, width, height);
  }
  const double threshold = std::max(kDimmestOfDisc * brightest, kBrighterThanSky * sky / (2 * std::numbers::pi));
  if (!(brightest > threshold)) return std::nullopt;
  const SunRegion region = growSun(picture, peak, threshold);
  if (region.tooLarge) return std::nullopt;

  const uint32_t base =
      sharedExponent(static_cast<float>(region.around.x), static_cast<float>(region.around.y), static_cast<float>(region.around.z));
  const Double3 around = unpackTexel(base);
  Double3 light = {0, 0, 0}, toward = {0, 0, 0};
  double sum = 0, squares = 0;
  for (const uint32_t at : region.texels) {
    const uint32_t x = at % width, y = at / width;
    const Double3 color = unpackTexel(picture.texels[at]), direction = mapDirection(x + 0.5, y + 0.5, width, height);
    const double angle = texelSolidAngle(y, width, height), excess = std::max(luminance(color) - luminance(around), 0.0);
    for (int c = 0; c < 3; ++c) {
      light[c] += angle * (color[c] - around[c]);
      toward[c] += angle * excess * direction[c];
    }
    sum += angle * excess;
    squares += angle * excess * excess;
  }
  const double size = length(toward);
  if (!(sum > kLeastLight * (sky - sum)) || !(size > 0) || !(toward.y > 0)) return std::nullopt;
  for (const uint32_t at : region.texels) picture.texels[at] = base;
  EnvironmentSun sun;
  sun.direction = {static_cast<float>(toward.x / size), static_cast<float>(toward.y / size), static_cast<float>(toward.z / size)};
  const auto overPi = [](double irradiance) { return static_cast<float>(std::max(irradiance, 0.0) / std::numbers::pi); };
  sun.light = {overPi(light.x), overPi(light.y), overPi(light.z)};
  // A uniform disc of solid angle s has sum^2 / squares = s, whatever its rim.
  sun.radius = static_cast<float>(std::sqrt(sum * sum / squares / std::numbers::pi));
  return sun;
}

std::optional<EnvironmentSun> findSun(const EnvironmentPicture& picture) {
  if (!checkEnvironmentSize(picture.width, picture.height) || picture.texels.size() != size_t{picture.width} * picture.height)
    return std::nullopt;
  EnvironmentPicture copy = picture;
  return takeSun(copy);
}

}  // namespace rill
