#pragma once
// An environment map that replaces the sky a fluid reflects. rill/scene_io.hpp loads one from a file.
//
//   rill::EnvironmentPicture dusk{4, 2, {}};
//   dusk.texels.assign(4, rill::sharedExponent(0.9f, 0.5f, 0.3f));  // the upper row, then the lower one
//   dusk.texels.insert(dusk.texels.end(), 4, rill::sharedExponent(0.1f, 0.1f, 0.12f));
#include <cstdint>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"

namespace rill {

/// Equirectangular radiance map. Rows go from +y (first) to -y; the middle column looks along -z and columns
/// to its right turn toward +x. Texels are linear RGB, packed by sharedExponent(); 1 is white.
struct EnvironmentPicture {
  uint32_t width = 0, height = 0;     ///< texels; the width is twice the height, at most 8192 x 4096
  std::vector<uint32_t> texels = {};  ///< row by row
};

/// Packs to VK_FORMAT_E5B9G9R9_UFLOAT_PACK32 (9-bit mantissas, shared exponent). Components are clamped to
/// 0 .. 32768; NaN becomes 0.
RILL_API uint32_t sharedExponent(float r, float g, float b);

/// Fails with BadInput if EnvironmentPicture does not allow this size.
RILL_API Expected<void> checkEnvironmentSize(uint64_t width, uint64_t height);

}  // namespace rill
