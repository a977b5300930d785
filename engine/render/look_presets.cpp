// The appearances and surface methods that scenes name. Sources of the coefficients are in docs/rendering.md.
#include <algorithm>
#include <array>
#include <utility>

#include "core/look_names.hpp"
#include "rill/fluid_renderer.hpp"

namespace rill {

std::span<const std::string_view> fluidLooks() { return kLookNames; }

std::optional<SurfaceMethod> surfaceMethod(std::string_view name) {
  constexpr std::pair<std::string_view, SurfaceMethod> kAll[] = {{"auto", SurfaceMethod::Auto},
                                                                 {"planes", SurfaceMethod::Planes},
                                                                 {"curvature_flow", SurfaceMethod::CurvatureFlow},
                                                                 {"narrow_range", SurfaceMethod::NarrowRange}};
  for (const auto& [known, method] : kAll)
    if (known == name) return method;
  return std::nullopt;
}

std::optional<FluidLook> fluidLook(std::string_view name) {
  // In the order of kLookNames. Measured coefficients are those at 610, 550 and 465 nm. Not static: the library has no global state.
  const std::array<FluidLook, kLookNames.size()> looks{{
      {},
      {.absorption = {2550, 3210, 3770}, .scatter = {0.91f, 0.88f, 0.76f}, .refractionIndex = 1.35f, .aeration = 0},
      {.absorption = {60, 42, 16}, .scatter = {0.004f, 0.008f, 0.03f}, .aeration = 0},
      {.scatter = {0.52f, 0.30f, 0.20f}, .opaque = true, .refractionIndex = 1.3f, .highlight = 12, .sun = 1, .aeration = 0},
      {.absorption = {0.264f, 0.0565f, 0.0101f}, .scatter = {0.0006f, 0.0043f, 0.050f}},
      {.absorption = {0.328f, 0.12f, 0.20f},
       .scatter = {0.0127f, 0.0355f, 0.0228f},
       .scattering = {0.5f, 0.5f, 0.5f},
       .refractionIndex = 1.34f},
      {.absorption = {50.8f, 51.3f, 53.8f}, .scatter = {0.340f, 0.248f, 0.093f}, .scattering = {50, 50, 50}},
      {.absorption = {22, 50, 163}, .scatter = {0.24f, 0.107f, 0.031f}, .refractionIndex = 1.49f, .aeration = 0},
      {.absorption = {300, 300, 300},
       .scatter = {0.16f, 0.06f, 0.03f},
       .emission = {1.155f, 0.145f, 0},
       .refractionIndex = 1.25f,
       .highlight = 60,
       .sun = 2,
       .aeration = 0},
      {.absorption = {55, 70, 82}, .scatter = {0.91f, 0.88f, 0.76f}, .refractionIndex = 1.333f, .aeration = 0},
  }};
  const auto* found = std::ranges::find(kLookNames, name);
  if (found == kLookNames.end()) return std::nullopt;
  return looks[static_cast<size_t>(found - kLookNames.begin())];
}

}  // namespace rill
