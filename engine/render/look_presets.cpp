// The appearances and surface methods that scenes name.
#include <utility>

#include "rill/fluid_renderer.hpp"

namespace rill {
namespace {

constexpr std::string_view kNames[] = {"water", "milk", "ink", "clay", "pool"};

}  // namespace

std::span<const std::string_view> fluidLooks() { return kNames; }

std::optional<SurfaceMethod> surfaceMethod(std::string_view name) {
  constexpr std::pair<std::string_view, SurfaceMethod> kAll[] = {{"auto", SurfaceMethod::Auto},
                                                                 {"planes", SurfaceMethod::Planes},
                                                                 {"curvature_flow", SurfaceMethod::CurvatureFlow},
                                                                 {"narrow_range", SurfaceMethod::NarrowRange}};
  for (const auto& [known, method] : kAll)
    if (known == name) return method;
  return std::nullopt;
}

std::optional<FluidLook> fluidLook(std::string_view preset) {
  FluidLook look;
  if (preset == kNames[0]) return look;
  if (preset == kNames[1]) {
    look.absorption = {55, 60, 75};
    look.scatter = {0.84f, 0.82f, 0.76f};
    look.refractionIndex = 1.35f;
    look.aeration = 0;
    return look;
  }
  if (preset == kNames[2]) {
    look.absorption = {60, 42, 16};
    look.scatter = {0.004f, 0.008f, 0.03f};
    look.aeration = 0;
    return look;
  }
  if (preset == kNames[3]) {
    look.opaque = true;
    look.scatter = {0.52f, 0.30f, 0.20f};
    look.refractionIndex = 1.3f;
    look.highlight = 12;
    look.aeration = 0;
    look.sun = 1;
    return look;
  }
  if (preset == kNames[4]) {                       // pure water at 610, 550 and 465 nm
    look.absorption = {0.264f, 0.0565f, 0.0101f};  // Pope and Fry 1997
    look.scatter = {0.0006f, 0.0043f, 0.050f};     // 0.33 times backscattering (Morel 1974) over absorption: Morel and Prieur 1977
    return look;
  }
  return std::nullopt;
}

}  // namespace rill
