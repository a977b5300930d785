#include "render/surface_buffers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "shared/no_depth.h"

namespace rill {

SurfacePixel unpackPixel(const uint32_t* words) {
  SurfacePixel pixel{std::bit_cast<float>(words[0]), {}};
  if (std::signbit(pixel.depth) || words[0] >= kNoDepthBits) pixel.depth = std::numeric_limits<float>::infinity();
  const auto part = [](uint32_t bits) { return double(int32_t(bits << 18) >> 18) / 8191; };  // 14 bits, signed
  double x = part(words[1]), y = part(words[1] >> 14);
  const double z = 1 - std::abs(x) - std::abs(y), fold = std::max(-z, 0.0);
  x += x >= 0 ? -fold : fold;
  y += y >= 0 ? -fold : fold;
  const double size = std::sqrt(x * x + y * y + z * z);
  pixel.normal = {x / size, y / size, z / size};
  return pixel;
}

}  // namespace rill
