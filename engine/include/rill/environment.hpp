#pragma once
// A picture of what is all around, in place of the sky that a fluid reflects. rill/scene_io.hpp reads one from a file.
//
//   rill::EnvironmentPicture dusk{4, 2, {}};
//   dusk.texels.assign(4, rill::sharedExponent(0.9f, 0.5f, 0.3f));  // the upper row, then the lower one
//   dusk.texels.insert(dusk.texels.end(), 4, rill::sharedExponent(0.1f, 0.1f, 0.12f));
#include <cstdint>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"

namespace rill {

/// Radiance from all directions, equirectangular: rows from straight up (+y) to straight down, the middle column towards -z, one to its
/// right further towards +x. Each texel is linear RGB, as sharedExponent() makes it of three floats; 1 is white.
struct EnvironmentPicture {
  uint32_t width = 0, height = 0;     ///< texels; twice as wide as high, at most 8192 x 4096
  std::vector<uint32_t> texels = {};  ///< row by row
};

/// VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, nine bits of the largest component. Clamped to 0 .. 32768; what is no number counts as 0.
RILL_API uint32_t sharedExponent(float r, float g, float b);

/// BadInput where the size is not one that EnvironmentPicture allows.
RILL_API Expected<void> checkEnvironmentSize(uint64_t width, uint64_t height);

}  // namespace rill
