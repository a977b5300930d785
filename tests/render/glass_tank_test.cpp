// The glass tank: where its faces are, and their light against Fresnel's equations in double precision.
#include "views/glass_tank.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/scenery_rig.hpp"

namespace rill::test {
namespace {

struct Range {
  double low = 1e30, high = -1e30;
};

/// Extent of a quad along an axis.
Range extentOf(const GlassQuad& q, size_t axis) {
  const float corner[3] = {q.cornerX, q.cornerY, q.cornerZ}, first[3] = {q.firstX, q.firstY, q.firstZ},
              second[3] = {q.secondX, q.secondY, q.secondZ};
  return {corner[axis], double(corner[axis]) + first[axis] + second[axis]};
}

Domain tankDomain() {
  Domain domain;
  domain.min = {1, 2, 3};
  domain.max = {3, 3, 4};
  return domain;
}

TEST(GlassTank, LiesAroundTheDomain) {
  const Double3 origin = {1, 1, 1};
  const auto quads = glassQuads(tankDomain(), origin);
  ASSERT_FALSE(quads.empty());
  const double thick = 0.012 * 2;
  Range all[3];
  for (const GlassQuad& q : quads) {
    bool outside = false;
    for (size_t a = 0; a < 3; ++a) {
      const Range r = extentOf(q, a);
      all[a] = {std::min(all[a].low, r.low), std::max(all[a].high, r.high)};
      const double low = tankDomain().min[a] - origin[a], high = tankDomain().max[a] - origin[a];
      outside = outside || (a != 1 && (r.high <= low + 1e-6 || r.low >= high - 1e-6));
    }
    EXPECT_TRUE(outside) << "glass in the fluid's room";
  }
  EXPECT_NEAR(all[0].low, 0 - thick, 1e-6);
  EXPECT_NEAR(all[0].high, 2 + thick, 1e-6);
  EXPECT_NEAR(all[1].low, 1, 1e-6);
  EXPECT_NEAR(all[1].high, 2, 1e-6);
  EXPECT_NEAR(all[2].low, 2 - thick, 1e-6);
  EXPECT_NEAR(all[2].high, 3 + thick, 1e-6);
}

TEST(GlassTank, HasPanesOnClosedSidesAlone) {
  Domain domain = tankDomain();
  domain.open = 0b000010;  // +x
  for (const GlassQuad& q : glassQuads(domain, {})) {
    EXPECT_LE(q.outwardX, 0);
    EXPECT_LE(extentOf(q, 0).high, 3 + 1e-6);
  }
  domain.open = 0b110011;
  EXPECT_TRUE(glassQuads(domain, {}).empty());
}

TEST(GlassTank, EndsAtTheLevelOfAnOutflow) {
  Domain domain = tankDomain();
  domain.outflow = Outflow{Axis::PlusX, 0.4};
  double top[2] = {};
  for (const GlassQuad& q : glassQuads(domain, {}))
    if (q.outwardX != 0) top[q.outwardX > 0] = std::max(top[q.outwardX > 0], extentOf(q, 1).high);
  EXPECT_NEAR(top[0], 3, 1e-6);
  EXPECT_NEAR(top[1], 2.4, 1e-6);
}

class GlassTankOnGpu : public SceneryTest {
 protected:
  static constexpr uint32_t kWidth = 96, kHeight = 72;

  /// Of a tank without floor, seen from `eye`.
  std::vector<double> draw(const Double3& eye, const Double3& target) {
    Scene scene;
    scene.domain = tankDomain();
    scene.domain->open = 0b000100;
    scene.look.stage = "tank";
    FluidLook look;
    look.sun = 0;
    return SceneryTest::draw(scene, {eye, target, kFov}, kWidth, kHeight, look);
  }

  static constexpr double kFov = 20;
};

/// What a pane between uniform light of 1 and `behind` sends to the eye.
double throughPane(double behind, double cosine) {
  const double inner = std::sqrt(1 - (1 - cosine * cosine) / (1.52 * 1.52));
  const double s = (cosine - 1.52 * inner) / (cosine + 1.52 * inner), p = (inner - 1.52 * cosine) / (inner + 1.52 * cosine);
  const double face = 0.5 * (s * s + p * p), both = 2 * face / (1 + face);
  return both + (1 - both) * 0.97 * behind;
}

TEST_F(GlassTankOnGpu, ReflectsByFresnelsEquations) {
  // Straight through two panes, at an angle through two, and from inside through one.
  const auto across = draw({2, 2.5, 8}, {2, 2.5, 3.5});
  const size_t middle = kHeight / 2 * kWidth + kWidth / 2;
  EXPECT_NEAR(across[middle], throughPane(throughPane(1, 1), 1), 2e-3);
  const auto slanted = draw({2 - 3, 2.5, 3.5 + 3}, {2, 2.5, 3.5});
  EXPECT_NEAR(slanted[middle], throughPane(throughPane(1, std::sqrt(0.5)), std::sqrt(0.5)), 2e-3);
  const auto inside = draw({2, 2.5, 3.8}, {2, 2.5, 3.0});
  EXPECT_NEAR(inside[middle], throughPane(1, 1), 2e-3);
  EXPECT_NE(across[middle], 1.0);
}

TEST_F(GlassTankOnGpu, EdgesAreDarkerThanPanes) {
  const auto drawn = draw({2, 2.9, 5}, {2, 2.99, 4});
  // The polished band below the top of the front pane crosses the middle column.
  double least = 1;
  for (uint32_t y = 0; y < kHeight; ++y) least = std::min(least, drawn[y * kWidth + kWidth / 2]);
  EXPECT_LT(least, 0.8);
}

}  // namespace
}  // namespace rill::test
