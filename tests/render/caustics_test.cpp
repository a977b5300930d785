// Sunlight through the fluid against Snell, Fresnel and lens formulas in double precision.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/caustics_rig.hpp"

namespace rill::test {
namespace caustics_test {

TEST_F(CausticsOnGpu, FlatSurfaceTransmitsByFresnel) {
  fill(block({-2.2, -1, -5}, {2.2, 0, 3.2}, 0.2));
  for (const double degrees : {0.0, 30.0, 60.0}) {
    const SunView view = sunAt(degrees * kDegree, 2, -1);
    const Refracted seen = refracted(view, clear());
    // Light that lands in the middle of the view, over the light that goes there without fluid
    double sum = 0, count = 0;
    const uint32_t side = kCausticFine * view.width, edge = side / 4;
    for (uint32_t y = edge; y < side - edge; ++y)
      for (uint32_t x = edge; x < side - edge; ++x, ++count) sum += seen.light(view, x, y, 1);
    EXPECT_NEAR(sum / count, transmittance(degrees * kDegree, 1.333), 0.01) << degrees << " degrees";
  }
}

TEST_F(CausticsOnGpu, FlatSurfaceShiftsLightBySnell) {
  fill(block({-2.2, -1, -5}, {2.2, 0, 3.2}, 0.2));
  const double angle = 40 * kDegree, inner = std::asin(std::sin(angle) / 1.333);
  const SunView view = sunAt(angle, 2, -1);
  const Refracted seen = refracted(view, clear());
  double shift = 0, count = 0, path = 0;
  const uint32_t side = kCausticFine * view.width;
  for (uint32_t y = side / 3; y < 2 * side / 3; ++y)
    for (uint32_t x = side / 3; x < 2 * side / 3; ++x, ++count) {
      const Photon& photon = seen.photons[size_t{y} * side + x];
      shift += photon.v - y;
      path += photon.path - 1;
    }
  // Along v the floor's points are as far apart as the cosine of the sun's angle says.
  const double texel = view.texel / kCausticFine;
  EXPECT_NEAR(shift / count * texel, (std::tan(inner) - std::tan(angle)) * std::cos(angle), 0.005);
  EXPECT_NEAR(path / count * texel, 1 / std::cos(inner), 0.01);
}

// As much light lands as enters the fluid: photons that are absorbed by nothing and reflected at both surfaces of a ball alone.
TEST_F(CausticsOnGpu, KeepsEnergy) {
  const double radius = 1;
  fill(shells({0, 0, 0}, radius));
  const SunView view = sunAt(0, 4, -3);
  const Refracted seen = refracted(view, clear());
  // Light that a ball of this size lets through, by rings
  double expected = 0;
  for (int k = 0; k < 1000; ++k) {
    const double r = (k + 0.5) / 1000, angle = std::asin(r);
    expected += 2 * std::numbers::pi * radius * radius * r / 1000 * std::pow(transmittance(angle, 1.333), 2);
  }
  const double texel = view.texel / kCausticFine, landed = seen.total(1) * texel * texel;
  double covered = 0;
  for (uint32_t y = 0; y < kCausticFine * view.height; ++y)
    for (uint32_t x = 0; x < kCausticFine * view.width; ++x) covered += (1 - seen.light(view, x, y, 3)) * texel * texel;
  EXPECT_NEAR(covered / (std::numbers::pi * radius * radius), 1, 0.05);
  EXPECT_NEAR(landed / expected, 1, 0.05);
}

// A ball lens: from its center the paraxial focus is n D / (4 (n - 1)).
TEST_F(CausticsOnGpu, BallFocusesAtItsFocalLength) {
  const double radius = 1, index = 1.333, focal = index * 2 * radius / (4 * (index - 1));
  fill(shells({0, 0, 0}, radius));
  for (const double floor : {-1.6, -2.0, -2.4}) {
    const SunView view = sunAt(0, 3, floor);
    const Refracted seen = refracted(view, clear());
    // Paraxial light lands at the distance r (1 - floor / focal) from the axis.
    double product = 0, square = 0;
    const double texel = view.texel / kCausticFine, middle = (kCausticFine * view.width - 1) / 2.0;
    const uint32_t side = kCausticFine * view.width;
    for (uint32_t y = 0; y < side; ++y)
      for (uint32_t x = 0; x < side; ++x) {
        const double u = (x - middle) * texel, v = (y - middle) * texel;
        if (u * u + v * v > 0.0625 * radius * radius) continue;
        const Photon& photon = seen.photons[size_t{y} * side + x];
        product += u * (photon.u - middle) * texel + v * (photon.v - middle) * texel;
        square += u * u + v * v;
      }
    EXPECT_NEAR(-floor / (1 - product / square) / focal, 1, 0.05) << floor;
  }
}

TEST_F(CausticsOnGpu, AbsorbsAlongThePath) {
  fill(block({-2.2, -1, -5}, {2.2, 0, 3.2}, 0.2));
  FluidLook look = clear();
  look.absorption = {1.5f, 0.5f, 0.1f};
  const double angle = 40 * kDegree, inner = std::asin(std::sin(angle) / 1.333), rates[] = {1.5, 0.5, 0.1};
  const SunView view = sunAt(angle, 2, -1);
  const Refracted seen = refracted(view, look);
  const uint32_t side = kCausticFine * view.width, edge = side / 4;
  for (uint32_t c = 0; c < 3; ++c) {
    double sum = 0, count = 0;
    for (uint32_t y = edge; y < side - edge; ++y)
      for (uint32_t x = edge; x < side - edge; ++x, ++count) sum += seen.light(view, x, y, c);
    const double expected = transmittance(angle, 1.333) * std::exp(-rates[c] / std::cos(inner));
    EXPECT_NEAR(sum / count / expected, 1, 0.03) << c;
  }
}

TEST_F(CausticsOnGpu, HandlesParticlesOutOfView) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  fill({{1e9f, 1e9f, 1e9f, 0}, {nan, 0, 0, 0}, {0, infinite, 0, 0}, {1e6f, 0, 0, 0}, {0, -1e6f, 1e6f, 0}});
  const SunView view = sunAt(20 * kDegree, 1, -1);
  const Refracted seen = refracted(view, clear());
  EXPECT_TRUE(std::ranges::all_of(seen.sums, [](uint32_t sum) { return sum == 0; }));
  for (uint32_t y = 0; y < kCausticFine * view.height; ++y)
    for (uint32_t x = 0; x < kCausticFine * view.width; ++x) ASSERT_EQ(seen.light(view, x, y, 3), 1) << x << ", " << y;
}

}  // namespace caustics_test
}  // namespace rill::test
