// Mass, center of mass and inertia of shapes, and where bodies may touch others.
#include "shape/mass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape/contact_points.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace mass_test {

void expectEqual(const MassProperties& found, const MassProperties& expected, double limit) {
  EXPECT_NEAR(found.mass, expected.mass, limit * expected.mass);
  const double size = *std::ranges::max_element(expected.inertia);
  for (size_t k = 0; k < 6; ++k) EXPECT_NEAR(found.inertia[k], expected.inertia[k], limit * size) << k;
  for (size_t a = 0; a < 3; ++a) EXPECT_NEAR(found.center[a], expected.center[a], 1e-12);
}

TEST(Mass, OfBoxesAndBallsIsThatOfTextbooks) {
  const MassProperties box = massOf(BoxShape{{1, 2, 3}, {3, 6, 4}}, 500);
  EXPECT_DOUBLE_EQ(box.mass, 4000);
  EXPECT_DOUBLE_EQ(box.inertia[0], 4000.0 / 12 * (16 + 1));
  EXPECT_DOUBLE_EQ(box.inertia[1], 4000.0 / 12 * (4 + 1));
  EXPECT_DOUBLE_EQ(box.inertia[2], 4000.0 / 12 * (4 + 16));
  const MassProperties ball = massOf(SphereShape{{0, 0, 0}, 0.5}, 1000);
  EXPECT_DOUBLE_EQ(ball.mass, 1000 * std::numbers::pi / 6);
  for (size_t k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(ball.inertia[k], 0.1 * ball.mass);
}

TEST(Mass, OfMeshesIsThatOfTheShapeTheyApproximate) {
  expectEqual(massOf(MeshShape{.mesh = meshOf(boxMesh({-1, -2, -0.5}, {1, 2, 0.5}))}, 500),
              massOf(BoxShape{{-1, -2, -0.5}, {1, 2, 0.5}}, 500), 1e-12);
  expectEqual(massOf(MeshShape{.mesh = meshOf(ballMesh(0.5, 5))}, 1000), massOf(SphereShape{{0, 0, 0}, 0.5}, 1000), 0.01);
}

TEST(Mass, OfAMeshFarFromItsOriginIsAboutTheCenterOfMass) {
  const MassProperties m = massOf(MeshShape{.mesh = meshOf(boxMesh({9, 4, -3}, {11, 8, -2}))}, 500);
  const MassProperties box = massOf(BoxShape{{9, 4, -3}, {11, 8, -2}}, 500);
  EXPECT_NEAR(m.center.x, 10, 1e-9);
  EXPECT_NEAR(m.center.y, 6, 1e-9);
  EXPECT_NEAR(m.center.z, -2.5, 1e-9);
  for (size_t k = 0; k < 6; ++k) EXPECT_NEAR(m.inertia[k], box.inertia[k], 1e-6 * box.inertia[0]) << k;
}

TEST(Mass, ThatIsGivenIsSpreadOverTheVolume) {
  Solid solid{.shape = BoxShape{{0, 0, 0}, {1, 1, 1}}, .body = Body{.mass = 6}};
  EXPECT_DOUBLE_EQ(massOf(solid).mass, 6);
  EXPECT_DOUBLE_EQ(massOf(solid).inertia[0], 1);
}

TEST(ContactPoints, LieWithinTheSurfaceAndTouchIt) {
  const std::vector<Shape> shapes = {BoxShape{{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}, BoxShape{{-1, -0.02, -0.1}, {1, 0.02, 0.1}},
                                     SphereShape{{0, 0, 0}, 0.3}, MeshShape{.mesh = meshOf(ballMesh(0.3, 4))},
                                     MeshShape{.mesh = meshOf(boxMesh({-1, -1, -1}, {1, 1, 1}))}};
  for (const Shape& shape : shapes) {
    const std::vector<ContactPoint> points = contactPoints(shape);
    EXPECT_LE(points.size(), kMaxContactPoints);
    for (const ContactPoint& point : points)
      EXPECT_NEAR(surfaceAt(shape, point.center).distance + point.radius, 0, 1e-6 * boundingRadius(shape));
    // Toward each direction, one is nearly as far out as the surface.
    if (std::holds_alternative<SphereShape>(shape)) continue;
    const Double3 half = halfExtents(shape);
    for (size_t a = 0; a < 3; ++a)
      for (const double sign : {-1.0, 1.0}) {
        double farthest = 0;
        for (const ContactPoint& point : points) farthest = std::max(farthest, sign * point.center[a] + point.radius);
        EXPECT_GT(farthest, 0.97 * half[a]);
      }
  }
  EXPECT_EQ(contactPoints(shapes[0]).size(), 26u);
  EXPECT_EQ(contactPoints(shapes[2]).size(), 1u);
  EXPECT_EQ(contactPoints(shapes[3]).size(), kMaxContactPoints);
}

}  // namespace mass_test
}  // namespace rill::test
