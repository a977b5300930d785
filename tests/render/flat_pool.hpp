#pragma once
// A flat pool of fluid, seen at one angle (orthographic) or at many (perspective).
#include <array>
#include <cmath>
#include <vector>

#include "render/surface_rig.hpp"

namespace rill::test {
namespace shading_test {

inline constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
using Color = std::array<double, 4>;  // linear; the fourth is 1

/// Of unpolarized light that meets a surface at an angle (rad) to its normal: Fresnel's equations in the angles, by Snell's law.
inline double fresnel(double angle, double index) {
  if (angle < 1e-6) return std::pow((index - 1) / (index + 1), 2);
  const double inner = std::asin(std::sin(angle) / index);
  const double across = std::sin(angle - inner) / std::sin(angle + inner), within = std::tan(angle - inner) / std::tan(angle + inner);
  return 0.5 * (across * across + within * within);
}

class FlatPool : public SurfaceOnGpu {
 protected:
  static constexpr uint32_t kAcross = 160, kDown = 120;
  static constexpr double kDistance = 5;

  /// A pool of this depth whose surface is y = 0.
  void pool(double depth, double half = 2.6) { fill(block({-half, -depth, -half}, {half, 0, half}, 0)); }
  /// Seen at an angle (rad) from straight above, from the side of +z.
  static FluidView eye(double angle) {
    return looking({0, kDistance * std::cos(angle), kDistance * std::sin(angle)}, {0, 0, 0}, kAcross, kDown);
  }
  static FluidView parallel(double angle) { return orthographic(0.5, eye(angle)); }
  static Vector sightOf(double angle) { return {0, -std::cos(angle), -std::sin(angle)}; }

  static FluidLook clear() {
    FluidLook look;
    look.absorption = look.scatter = {0, 0, 0};
    look.sun = 0;
    look.toSun = {0, -1, 0};  // from below: no glow around it in what the pool mirrors
    return look;
  }
  std::vector<Color> seen(const FluidView& view, const FluidLook& look, std::array<float, 4> behind,
                          const std::vector<float>& depths = {}) {
    Backdrop backdrop;
    backdrop.depths = depths;
    backdrop.color = behind;
    backdrop.depth = view.projection.column[2].w == 0 ? 1.0f : 0.0f;  // as far as there is
    return drawn(view, look, backdrop, {.color = kFormat}).channels(kFormat);
  }
  /// What of the light behind comes through, whatever is mirrored: the difference that a white backdrop makes.
  std::vector<Color> through(const FluidView& view, const FluidLook& look) {
    auto white = seen(view, look, {1, 1, 1, 1});
    const auto black = seen(view, look, {0, 0, 0, 1});
    for (size_t i = 0; i < white.size(); ++i)
      for (size_t c = 0; c < 3; ++c) white[i][c] -= black.at(i)[c];
    return white;
  }
  static Color mean(const std::vector<Color>& pixels) {
    Color sum{};
    for (const Color& pixel : pixels)
      for (size_t c = 0; c < 4; ++c) sum[c] += pixel[c] / double(pixels.size());
    return sum;
  }
};

}  // namespace shading_test
}  // namespace rill::test
