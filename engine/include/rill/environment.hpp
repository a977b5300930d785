#pragma once
// A picture of what is all around, in place of the sky that a fluid reflects.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "rill/expected.hpp"

namespace rill {

/// Radiance from all directions, equirectangular: rows from straight up (+y) to straight down, the middle column towards -z, one to its
/// right further towards +x. Each texel is linear RGB, as sharedExponent() makes it of three floats; 1 is white.
struct EnvironmentPicture {
  uint32_t width = 0, height = 0;  ///< texels; twice as wide as high, at most 8192 x 4096
  std::vector<uint32_t> texels;    ///< row by row
};

/// VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, nine bits of the largest component. Clamped to 0 .. 32768; what is no number counts as 0.
uint32_t sharedExponent(float r, float g, float b);

/// BadInput where the size is not one that EnvironmentPicture allows.
Expected<void> checkEnvironmentSize(uint64_t width, uint64_t height);

/// Reads a Radiance picture (.hdr), or a PNG or JPEG, which is taken as sRGB. BadInput with one message naming the file, what was found and
/// what was expected; OutOfMemory, Io.
Expected<EnvironmentPicture> loadEnvironment(const std::filesystem::path& file);

}  // namespace rill
