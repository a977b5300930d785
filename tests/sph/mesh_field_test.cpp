// The field of a mesh against the mesh itself, and the density that it displaces against spheres and boxes.
#include "sph/mesh_field.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sph/solid_density.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace mesh_field_test {

constexpr double kSpacing = 0.1;

const SmoothingKernel kKernel(KernelChoice::Wendland, 2.3 * kSpacing, kSpacing);

/// Points at random distances of 0.45 spacings to what a solid displaces from the surface of a shape, and what is there.
template <class Visit>
void forPointsNear(const MeshShape& shape, double reach, const Visit& visit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 20000; ++n) {
    Double3 x{unit(random), unit(random), unit(random)};
    for (double& c : x) c *= reach + solidReach(kKernel);
    const SurfacePoint at = surfaceAt(shape, x);
    if (at.distance > 0.45 * kSpacing && at.distance < solidReach(kKernel)) visit(x, at);
  }
}

double difference(const Double3& a, const Double3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

// The bounds are a fourth above what was measured. The distance of a ball is d^2 / 24 R off at nodes, its normal d / 4 R. Means are
// those that interpolation would shift: by 0.013 and 0.007 spacings, and in contact by 0.0036 and 0.0016 of the density.
TEST(MeshField, BallDisplacesAsSphere) {
  const HalfSpaceTable half = makeHalfSpaceTable(kKernel);
  struct Bounds {
    double radius, distance, normal, density, gradient;  // spacings, radians, fractions
    double meanDensity;                                  // in contact
  };
  for (const Bounds& b : {Bounds{2, 0.026, 0.17, 0.0082, 0.18, 0.0022}, {5, 0.0105, 0.08, 0.007, 0.09, 0.0004}}) {
    const double R = b.radius * kSpacing;
    const MeshShape shape{.mesh = meshOf(ballMesh(R, 5))};
    const auto field = MeshField::create(*shape.mesh, kKernel);
    ASSERT_TRUE(field);
    double distanceError = 0, densityError = 0, points = 0, inContact = 0;
    const double steepest = std::abs(exactSphere(kKernel, R, 0.5 * kSpacing).slope);
    forPointsNear(shape, R, [&](const Double3& x, const SurfacePoint& at) {
      const MeshField::Sample sample = field->sample(x);
      EXPECT_NEAR(sample.distance, at.distance, b.distance * kSpacing);
      const double slope = std::hypot(sample.gradient.x, sample.gradient.y, sample.gradient.z);
      EXPECT_LT(difference({sample.gradient.x / slope, sample.gradient.y / slope, sample.gradient.z / slope}, at.normal), b.normal);
      const LineSample exact = exactSphere(kKernel, R, at.distance);
      const SolidSample own = meshSample(half, *field, x);
      EXPECT_NEAR(own.value, exact.value, b.density);
      distanceError += sample.distance - at.distance;
      points += 1;
      if (at.distance < 0.6 * kSpacing) {
        densityError += own.value - exact.value;
        inContact += 1;
      }
      EXPECT_LT(difference(own.gradient, {exact.slope * at.normal.x, exact.slope * at.normal.y, exact.slope * at.normal.z}),
                b.gradient * steepest);
    });
    EXPECT_NEAR(distanceError / points, 0, 5e-4 * kSpacing);
    EXPECT_NEAR(densityError / inContact, 0, b.meanDensity);
  }
}

TEST(MeshField, FlatFacesDisplaceAsHalfSpaces) {
  const HalfSpaceTable half = makeHalfSpaceTable(kKernel);
  constexpr double kHalf = 5 * kSpacing;
  const MeshShape shape{.mesh = meshOf(boxMesh({-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}))};
  const auto field = MeshField::create(*shape.mesh, kKernel);
  ASSERT_TRUE(field);
  int faces = 0;
  forPointsNear(shape, kHalf, [&](const Double3& x, const SurfacePoint& at) {
    const SolidSample box = boxSample(half, x, {kHalf, kHalf, kHalf}), own = meshSample(half, *field, x);
    int near = 0;
    for (double c : x) near += std::abs(c) > kHalf - kKernel.h();
    if (near == 1) {
      ++faces;
      EXPECT_NEAR(own.value, box.value, 5e-4);
      EXPECT_LT(difference(own.gradient, box.gradient), 0.02 / kSpacing) << at.distance;
    }
    EXPECT_NEAR(own.value, box.value, 0.03) << "a box is the product of its slabs, at edges as well";
  });
  EXPECT_GT(faces, 500);
}

// A plate one spacing thick, closed or a sheet, displaces less than a half-space, and the same on both sides.
TEST(MeshField, ThinPlatesDisplaceByTheirThickness) {
  const HalfSpaceTable half = makeHalfSpaceTable(kKernel);
  constexpr double kWide = 8 * kSpacing;
  const auto plate = meshOf(boxMesh({-kWide, -kSpacing / 2, -kWide}, {kWide, kSpacing / 2, kWide}));
  MeshData flat;
  flat.vertices = {{-kWide, 0, -kWide}, {kWide, 0, -kWide}, {kWide, 0, kWide}, {-kWide, 0, kWide}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto sheet = meshOf(flat, true);
  for (const auto& mesh : {plate, sheet}) {
    const auto field = MeshField::create(*mesh, kKernel);
    ASSERT_TRUE(field);
    for (double s : {0.5, 0.8, 1.2}) {
      const SolidSample slab = boxSample(half, {0, (s + 0.5) * kSpacing, 0}, {kWide, kSpacing / 2, kWide});
      const SolidSample above = meshSample(half, *field, {0.013, (s + 0.5) * kSpacing, 0.02}),
                        below = meshSample(half, *field, {0.013, -(s + 0.5) * kSpacing, 0.02});
      EXPECT_NEAR(above.value, slab.value, 0.012) << s;
      EXPECT_NEAR(above.value, below.value, 1e-3) << s;
      EXPECT_NEAR(above.gradient.y, -below.gradient.y, 0.01 / kSpacing) << s;
    }
  }
}

TEST(MeshField, GradientIsThatOfTheDensity) {
  const HalfSpaceTable half = makeHalfSpaceTable(kKernel);
  const MeshShape shape{.mesh = meshOf(joined(ballMesh(0.3, 3), boxMesh({0.1, -0.1, -0.1}, {0.6, 0.2, 0.1})))};
  const auto field = MeshField::create(*shape.mesh, kKernel);
  ASSERT_TRUE(field);
  int wrong = 0, all = 0;
  forPointsNear(shape, 0.5, [&](const Double3& x, const SurfacePoint&) {
    const double step = 1e-5 * kSpacing;
    const SolidSample own = meshSample(half, *field, x);
    Double3 slope;
    for (size_t a = 0; a < 3; ++a) {
      Double3 low = x, high = x;
      low[a] -= step;
      high[a] += step;
      slope[a] = (meshSample(half, *field, high).value - meshSample(half, *field, low).value) / (2 * step);
    }
    // The table's slope is exact, that of its values a difference over a sixteenth of a spacing.
    wrong += difference(slope, own.gradient) > 0.03 / kSpacing;
    ++all;
  });
  EXPECT_GT(all, 1000);
  EXPECT_LT(wrong, all / 200) << "where a cell or an entry ends within the step";
}

TEST(MeshField, RefusesWhatIsTooLarge) {
  const auto large = MeshField::create(*meshOf(boxMesh({0, 0, 0}, {1e6, 1, 1e6})), kKernel);
  ASSERT_FALSE(large);
  EXPECT_EQ(large.error().kind, ErrorKind::TooLarge);
  EXPECT_NE(large.error().message.find("1e+06 x 1 x 1e+06 m"), std::string::npos) << large.error().message;
}

}  // namespace mesh_field_test
}  // namespace rill::test
