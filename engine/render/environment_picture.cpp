#include <algorithm>
#include <cmath>
#include <string>

#include "rill/environment.hpp"

namespace rill {
namespace {

constexpr uint32_t kMaxWidth = 8192;
constexpr float kMaxRadiance = 32768;  // half of the largest 16-bit float, because reflections add up

}  // namespace

uint32_t sharedExponent(float r, float g, float b) {
  const auto bounded = [](float c) { return c > 0 ? std::min(c, kMaxRadiance) : 0.0f; };
  const float rgb[3] = {bounded(r), bounded(g), bounded(b)};
  const float largest = std::max({rgb[0], rgb[1], rgb[2]});
  // A component is its nine bits times 2^(exponent - 24).
  int power = 0;
  std::frexp(largest, &power);  // largest is below 2^power
  int exponent = std::max(power + 15, 0);
  if (std::lround(std::ldexp(largest, 24 - exponent)) == 512) ++exponent;
  uint32_t packed = static_cast<uint32_t>(exponent) << 27;
  for (int k = 0; k < 3; ++k) packed |= static_cast<uint32_t>(std::lround(std::ldexp(rgb[k], 24 - exponent))) << (9 * k);
  return packed;
}

Expected<void> checkEnvironmentSize(uint64_t width, uint64_t height) {
  if (width == 2 * height && height > 0 && width <= kMaxWidth) return {};
  return Error{ErrorKind::BadInput, "found " + std::to_string(width) + "x" + std::to_string(height) +
                                        " pixels; expected twice as wide as high, at most " + std::to_string(kMaxWidth) + "x" +
                                        std::to_string(kMaxWidth / 2)};
}

}  // namespace rill
