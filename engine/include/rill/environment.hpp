#pragma once
// An environment map that replaces the sky a fluid reflects. rill/scene_io.hpp loads one from a file.
//
//   rill::EnvironmentPicture dusk{4, 2, {}};
//   dusk.texels.assign(4, rill::sharedExponent(0.9f, 0.5f, 0.3f));  // the upper row, then the lower one
//   dusk.texels.insert(dusk.texels.end(), 4, rill::sharedExponent(0.1f, 0.1f, 0.12f));
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rill/expected.hpp"
#include "rill/export.hpp"
#include "rill/vectors.hpp"

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

/// The sun of an environment.
struct EnvironmentSun {
  Float3 direction{0, 1, 0};  ///< towards the center of its disc, unit length, above the horizon
  Float3 light{};             ///< radiance of a white surface that faces it and sees nothing else, linear RGB
  float radius = 0;           ///< of a uniform disc with the same solid angle, rad
};

/// The sun of a picture: its brightest spot, if that is at most 10 degrees from its center to its rim and sends at least a tenth of the
/// sky's light. Empty for an overcast sky, for most pictures in sRGB, whose sun is clipped, and for an invalid picture.
RILL_API std::optional<EnvironmentSun> findSun(const EnvironmentPicture& picture);

/// A scene's `look.sky` as an environment: day or sunset, clear skies with the sun's disc after Hillaire (2020), over a sea, exposed for a
/// filmic tone curve. White ground has the radiance 1.9 by day and 0.35 at sunset. Empty for `studio`, the sky without an environment, and
/// for an unknown name.
RILL_API std::optional<EnvironmentPicture> skyPicture(std::string_view name);
/// Names of all skies.
RILL_API std::span<const std::string_view> skies();

}  // namespace rill
