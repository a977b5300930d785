#include "sph/surface_tension.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rill {
namespace {

// Over sqrt(density spacing^3 / tension). Stable up to 0.4, what the shortest capillary wave of a grid asks for (Brackbill, Kothe and
// Zemach 1992), where drops oscillate a tenth too slowly.
constexpr double kCapillaryStep = 0.2;

double areaOfSample() {
  return double{kTensionCalibration} * 4 * std::numbers::pi * double{kTensionRadius} * double{kTensionRadius} / kTensionSamples;
}

}  // namespace

std::array<Double3, kTensionSamples> tensionDirections() {
  constexpr double a = double{kTensionA}, b = double{kTensionB}, c = double{kTensionC};
  return {{{a, a, a}, {a, a, -a}, {a, -a, a},  {a, -a, -a}, {-a, -a, -a}, {-a, -a, a}, {-a, a, -a}, {-a, a, a}, {0, b, c},   {0, b, -c},
           {c, 0, b}, {c, 0, -b}, {0, -b, -c}, {0, -b, c},  {-c, 0, -b},  {-c, 0, b},  {b, c, 0},   {b, -c, 0}, {-b, -c, 0}, {-b, c, 0}}};
}

TensionWeight tensionWeight(double distance, double wettingCosine) {
  const double t = std::clamp(distance, 0.0, 1.0), whole = 1 + wettingCosine;
  return {whole * t * t * (3 - 2 * t) - wettingCosine, whole * 6 * t * (1 - t)};
}

TensionRates tensionRates(double tension, double density, double spacing) {
  const double support = double{kTensionSupport};
  const double unit = tension / (density * spacing * spacing) * areaOfSample();
  return {.rate = unit / spacing * 12 * double{kTensionAmplitude} / (support * support), .wall = unit};
}

double capillaryStep(double tension, double density, double spacing) {
  if (tension <= 0) return std::numeric_limits<double>::infinity();
  return kCapillaryStep * std::sqrt(density * spacing * spacing * spacing / tension);
}

}  // namespace rill
