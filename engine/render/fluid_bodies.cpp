// Colors of fluids as coefficients.
#include <algorithm>
#include <cmath>

#include "rill/fluid_renderer.hpp"

namespace rill {
namespace {

constexpr double kColorPath = 0.1;      // m of fluid that FluidMaterial::color is seen through
constexpr double kDarkestColor = 1e-4;  // least transmittance of that path: 92 1/m
constexpr double kHaze = 0.09;          // 1/m, what clear liquids scatter back: that of the preset `water`

}  // namespace

FluidBody fluidBody(const std::optional<Double3>& color) {
  FluidBody body;
  if (!color) return body;
  double rates[3], reflected[3];
  for (int c = 0; c < 3; ++c) {
    const double left = (*color)[c];
    rates[c] = -std::log(left > kDarkestColor ? std::min(left, 1.0) : kDarkestColor) / kColorPath;
    reflected[c] = kHaze / (kHaze + rates[c]);
  }
  const auto rgb = [](const double* v) { return Float3{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; };
  body.absorption = rgb(rates);
  body.scatter = rgb(reflected);
  return body;
}

std::vector<FluidBody> fluidBodies(const Scene& scene) {
  std::vector<FluidBody> bodies;
  for (const FluidMaterial& fluid : scene.fluids) bodies.push_back(fluidBody(fluid.color));
  for (const size_t k : diffusingFluids(scene)) bodies[k].diffuses = true;
  const bool colored = std::ranges::any_of(bodies, [](const FluidBody& body) { return body.absorption.has_value(); });
  return colored ? bodies : std::vector<FluidBody>{};
}

}  // namespace rill
