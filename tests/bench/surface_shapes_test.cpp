// Checks the analytic reference surfaces: normals match the depth, particles lie below the surface.
#include "bench/surface_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/surface_errors.hpp"

namespace rill::bench {
namespace {

constexpr Eye kEye{48, 36, 0.36 * 4 / 3, 0.36, 60};

using Vector = Double3;
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::vector<std::unique_ptr<Shape>> allShapes() {
  auto all = shapes(kEye.distance, kEye.tanHalfFovX, kEye.tanHalfFovY);
  for (auto& tilted : tiltedShapes(kEye.distance, kEye.tanHalfFovX, kEye.tanHalfFovY)) all.push_back(std::move(tilted));
  all.push_back(travelingWave(kEye.distance, kEye.tanHalfFovX, kEye.tanHalfFovY, 18, 3.7));
  return all;
}

TEST(SurfaceShapes, NormalsMatchDepthGradient) {
  for (const auto& shape : allShapes()) {
    int seen = 0;
    const auto pointAt = [&](double x, double y, Vector& point) {
      ReferencePoint hit;
      if (!shape->intersect(x, y, hit)) return false;
      point = {hit.depth * x, hit.depth * y, hit.depth};
      return true;
    };
    for (double y = -0.35; y < 0.36; y += 0.0271)
      for (double x = -0.47; x < 0.48; x += 0.0313) {
        ReferencePoint reference;
        const double d = 1e-6;
        Vector left, right, down, up;
        if (!shape->intersect(x, y, reference) || !pointAt(x - d, y, left) || !pointAt(x + d, y, right) || !pointAt(x, y - d, down) ||
            !pointAt(x, y + d, up))
          continue;
        Vector normal = cross(up - down, right - left);
        const double size = std::sqrt(dot(normal, normal));
        for (double& v : normal) v /= size;
        EXPECT_NEAR(dot(normal, reference.normal), 1, 1e-6) << shape->name() << " at " << x << ", " << y;
        EXPECT_LT(x * reference.normal[0] + y * reference.normal[1] + reference.normal[2], 0)
            << shape->name() << ": faces away from the eye";
        ++seen;
      }
    EXPECT_GT(seen, 100) << shape->name();
  }
}

TEST(SurfaceShapes, FirstLayerOfParticlesIsHalfASpacingDeep) {
  for (const auto& shape : allShapes()) {
    int seen = 0, first = 0;
    for (const Float3& p : shape->particles({0, 0}, 1)) {
      const double x = double(p.x) / p.z, y = double(p.y) / p.z;
      if (std::abs(x) > kEye.tanHalfFovX || std::abs(y) > kEye.tanHalfFovY) continue;
      ReferencePoint reference;
      ASSERT_TRUE(shape->intersect(x, y, reference)) << shape->name();
      const double under = (reference.depth - p.z) *
                           (x * reference.normal[0] + y * reference.normal[1] + reference.normal[2]);  // distance to the tangent plane
      EXPECT_GT(under, 0.35) << shape->name() << " at " << p.x << ", " << p.y << ", " << p.z;
      ++seen;
      first += under < 0.65;
    }
    EXPECT_GT(seen, 100) << shape->name();
    EXPECT_GT(first, seen / 8) << shape->name() << ": no layer at a depth of half a spacing";
  }
}

TEST(SurfaceShapes, ParticlesOscillateWithTravelingWave) {
  const auto wave = [](double traveled) { return travelingWave(kEye.distance, kEye.tanHalfFovX, kEye.tanHalfFovY, 18, traveled); };
  const auto before = wave(0)->particles({}, 1), after = wave(0.25)->particles({}, 1), round = wave(18)->particles({}, 1);
  ASSERT_EQ(before.size(), after.size());
  double farthest = 0, drift = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    farthest = std::max(farthest,
                        std::hypot(double(after[i].x) - before[i].x, double(after[i].y) - before[i].y, double(after[i].z) - before[i].z));
    drift = std::max(drift, std::hypot(double(round[i].x) - before[i].x, double(round[i].z) - before[i].z));
  }
  EXPECT_GT(farthest, 0.05);
  EXPECT_LT(farthest, 0.3) << "farther than the wave";
  EXPECT_LT(drift, 1e-4) << "not periodic in the wavelength";
  ReferencePoint still, moved;
  ASSERT_TRUE(wave(0)->intersect(0, 0, still));
  ASSERT_TRUE(wave(4.5)->intersect(0, 0, moved));
  EXPECT_NEAR(still.depth - moved.depth, 0.05 * 18, 1e-9) << "a quarter of a wavelength moves the crest to the center";
}

/// The reference surface as a rendered one, its normals rotated by `tilt` radians around y.
RenderedSurface renderedOf(const ReferenceSurface& surface, double tilt) {
  RenderedSurface rendered;
  for (size_t i = 0; i < surface.points.size(); ++i) {
    const ReferencePoint& t = surface.points[i];
    rendered.depth.push_back(surface.regions[i] == ReferenceSurface::Region::Outside ? INFINITY : float(t.depth));
    rendered.normal.push_back({t.normal[0] * std::cos(tilt) + t.normal[2] * std::sin(tilt), t.normal[1],
                               t.normal[2] * std::cos(tilt) - t.normal[0] * std::sin(tilt)});
  }
  return rendered;
}

TEST(SurfaceErrors, AreZeroForReferenceAndEqualTilt) {
  const double degree = std::acos(-1.0) / 180;
  for (const auto& shape : allShapes()) {
    const ReferenceSurface surface = referenceSurface(*shape, kEye);
    const Errors none = surfaceErrors(surface, renderedOf(surface, 0));
    EXPECT_NEAR(none.mean, 0, 1e-5) << shape->name();
    EXPECT_NEAR(none.depth, 0, 1e-4) << shape->name();
    EXPECT_EQ(none.iou, 1) << shape->name();
    if (shape->name() != "plane" && !shape->name().starts_with("waves")) continue;  // the other shapes have normals with a y component
    const Errors tilted = surfaceErrors(surface, renderedOf(surface, 3 * degree));
    EXPECT_NEAR(tilted.mean, 3, 1e-6) << shape->name();
    EXPECT_NEAR(tilted.p95, 3, 1e-6) << shape->name();
  }
}

TEST(SurfaceErrors, IouCountsMissingAndExtraPixels) {
  ReferenceSurface surface;
  surface.points.resize(4);
  surface.regions = {ReferenceSurface::Region::Interior, ReferenceSurface::Region::Interior, ReferenceSurface::Region::Outside,
                     ReferenceSurface::Region::Outside};
  RenderedSurface rendered;
  rendered.depth = {0, INFINITY, 0, INFINITY};
  rendered.normal.resize(4, {0, 0, -1});
  EXPECT_DOUBLE_EQ(surfaceErrors(surface, rendered).iou, 1.0 / 3);
}

TEST(SurfaceErrors, ErrorChangeExcludesReferenceMotion) {
  const double degree = std::acos(-1.0) / 180;
  const auto at = [](double traveled) {
    return referenceSurface(*travelingWave(kEye.distance, kEye.tanHalfFovX, kEye.tanHalfFovY, 18, traveled), kEye);
  };
  const ReferenceSurface before = at(0), after = at(2);
  EXPECT_GT(normalChange(renderedOf(before, 0), renderedOf(after, 0), 10), 1) << "the wave moved";
  EXPECT_NEAR(errorChange(before, renderedOf(before, 0), after, renderedOf(after, 0)), 0, 1e-5);
  EXPECT_NEAR(errorChange(before, renderedOf(before, 2 * degree), after, renderedOf(after, 2 * degree)), 0, 1e-5)
      << "the error moves with the wave";
  EXPECT_NEAR(errorChange(before, renderedOf(before, 2 * degree), after, renderedOf(after, -degree)), 3, 1e-5);
}

}  // namespace
}  // namespace rill::bench
