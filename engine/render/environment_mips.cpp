#include "render/environment_mips.hpp"

#include <algorithm>
#include <utility>

#include "render/environment_texels.hpp"

namespace rill {
namespace {

using Texels = std::vector<Float3>;

/// The next level of `fine(x, y)`, which has `rows` rows.
template <class Fine>
Texels halved(uint32_t rows, const Fine& fine) {
  const uint32_t wide = 2 * rows, down = std::max(rows / 2, 1u), across = 2 * down;
  const double step = std::numbers::pi / rows;
  Texels out;
  out.reserve(size_t{down} * across);
  std::vector<std::pair<uint32_t, double>> lines;  // rows that a texel covers, and their heights on the sphere
  for (uint32_t y = 0; y < down; ++y) {
    const double top = double(y) * rows / down, bottom = double(y + 1) * rows / down;
    lines.clear();
    for (auto v = static_cast<uint32_t>(top); v < std::min(static_cast<uint32_t>(std::ceil(bottom)), rows); ++v)
      lines.emplace_back(v, std::cos(std::max(top, double(v)) * step) - std::cos(std::min(bottom, v + 1.0) * step));
    for (uint32_t x = 0; x < across; ++x) {
      const double left = double(x) * wide / across, right = double(x + 1) * wide / across;
      Double3 sum = {0, 0, 0};
      double weights = 0;
      for (auto u = static_cast<uint32_t>(left); u < std::min(static_cast<uint32_t>(std::ceil(right)), wide); ++u)
        for (const auto& [v, height] : lines) {
          const double weight = height * (std::min(right, u + 1.0) - std::max(left, double(u)));
          const auto color = fine(u, v);
          sum.x += weight * color.x, sum.y += weight * color.y, sum.z += weight * color.z;
          weights += weight;
        }
      out.push_back({static_cast<float>(sum.x / weights), static_cast<float>(sum.y / weights), static_cast<float>(sum.z / weights)});
    }
  }
  return out;
}

}  // namespace

std::vector<uint32_t> environmentLevels(const EnvironmentPicture& picture) {
  std::vector<uint32_t> out = picture.texels;
  Texels level;
  for (uint32_t rows = picture.height; rows > 1; rows = std::max(rows / 2, 1u)) {
    const uint32_t wide = 2 * rows;
    if (level.empty())
      level = halved(rows, [&](uint32_t x, uint32_t y) { return unpackTexel(picture.texels[size_t{y} * wide + x]); });
    else
      level = halved(rows, [&](uint32_t x, uint32_t y) { return level[size_t{y} * wide + x]; });
    for (const Float3& texel : level) out.push_back(sharedExponent(texel.x, texel.y, texel.z));
  }
  return out;
}

uint32_t dropFineLevels(std::vector<uint32_t>& levels, uint32_t rows, uint64_t maxBytes) {
  while (rows > 1 && levels.size() * sizeof(uint32_t) > maxBytes) {
    levels.erase(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(2 * uint64_t{rows} * rows));
    rows /= 2;
  }
  return rows;
}

}  // namespace rill
