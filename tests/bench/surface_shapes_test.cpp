// The truth that surfaces are held against is itself held against arithmetic: normals are those of the depth, particles lie under it.
#include "bench/surface_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/surface_errors.hpp"

namespace rill::bench {
namespace {

constexpr Eye kEye{48, 36, 0.36 * 4 / 3, 0.36, 60};

using Vector = std::array<double, 3>;
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
double dot(const Vector& a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::vector<std::unique_ptr<Shape>> everyShape() {
  auto all = shapes(kEye.distance, kEye.tangentX, kEye.tangentY);
  for (auto& tilted : tiltedShapes(kEye.distance, kEye.tangentX, kEye.tangentY)) all.push_back(std::move(tilted));
  all.push_back(traveledWave(kEye.distance, kEye.tangentX, kEye.tangentY, 18, 3.7));
  return all;
}

TEST(SurfaceShapes, NormalsAreThoseOfTheDepth) {
  for (const auto& shape : everyShape()) {
    int seen = 0;
    const auto pointAt = [&](double x, double y, Vector& point) {
      Truth there;
      if (!shape->hit(x, y, there)) return false;
      point = {there.depth * x, there.depth * y, there.depth};
      return true;
    };
    for (double y = -0.35; y < 0.36; y += 0.0271)
      for (double x = -0.47; x < 0.48; x += 0.0313) {
        Truth truth;
        const double d = 1e-6;
        Vector left, right, down, up;
        if (!shape->hit(x, y, truth) || !pointAt(x - d, y, left) || !pointAt(x + d, y, right) || !pointAt(x, y - d, down) ||
            !pointAt(x, y + d, up))
          continue;
        Vector normal = cross(up - down, right - left);
        const double size = std::sqrt(dot(normal, normal.data()));
        for (double& v : normal) v /= size;
        EXPECT_NEAR(dot(normal, truth.normal), 1, 1e-6) << shape->name() << " at " << x << ", " << y;
        EXPECT_LT(x * truth.normal[0] + y * truth.normal[1] + truth.normal[2], 0) << shape->name() << ": looks away from the eye";
        ++seen;
      }
    EXPECT_GT(seen, 100) << shape->name();
  }
}

TEST(SurfaceShapes, ParticlesLieUnderTheSurfaceFromHalfASpacingOn) {
  for (const auto& shape : everyShape()) {
    int seen = 0, first = 0;
    for (const Float3& p : shape->particles({0, 0}, 1)) {
      const double x = double(p.x) / p.z, y = double(p.y) / p.z;
      if (std::abs(x) > kEye.tangentX || std::abs(y) > kEye.tangentY) continue;
      Truth truth;
      ASSERT_TRUE(shape->hit(x, y, truth)) << shape->name();
      const double under = (truth.depth - p.z) * (x * truth.normal[0] + y * truth.normal[1] + truth.normal[2]);  // of the plane at the hit
      EXPECT_GT(under, 0.35) << shape->name() << " at " << p.x << ", " << p.y << ", " << p.z;
      ++seen;
      first += under < 0.65;
    }
    EXPECT_GT(seen, 100) << shape->name();
    EXPECT_GT(first, seen / 8) << shape->name() << ": a layer at half a spacing";
  }
}

TEST(SurfaceShapes, AWaveTravelsAndItsParticlesRideOnIt) {
  const auto wave = [](double traveled) { return traveledWave(kEye.distance, kEye.tangentX, kEye.tangentY, 18, traveled); };
  const auto before = wave(0)->particles({}, 1), after = wave(0.25)->particles({}, 1), round = wave(18)->particles({}, 1);
  ASSERT_EQ(before.size(), after.size());
  double most = 0, drift = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    most = std::max(most, std::hypot(double(after[i].x) - before[i].x, double(after[i].y) - before[i].y, double(after[i].z) - before[i].z));
    drift = std::max(drift, std::hypot(double(round[i].x) - before[i].x, double(round[i].z) - before[i].z));
  }
  EXPECT_GT(most, 0.05);
  EXPECT_LT(most, 0.3) << "no farther than the wave";
  EXPECT_LT(drift, 1e-4) << "after a whole length all is as it was";
  Truth still, moved;
  ASSERT_TRUE(wave(0)->hit(0, 0, still));
  ASSERT_TRUE(wave(4.5)->hit(0, 0, moved));
  EXPECT_NEAR(still.depth - moved.depth, 0.05 * 18, 1e-9) << "a quarter of a length: from the middle to the crest";
}

/// The truth itself as a picture, its normals turned by `tilt` radians around y.
Drawn drawnOf(const TrueSurface& surface, double tilt) {
  Drawn drawn;
  for (size_t i = 0; i < surface.truth.size(); ++i) {
    const Truth& t = surface.truth[i];
    drawn.depth.push_back(surface.where[i] == TrueSurface::Where::Nowhere ? INFINITY : float(t.depth));
    drawn.normal.push_back({t.normal[0] * std::cos(tilt) + t.normal[2] * std::sin(tilt), t.normal[1],
                            t.normal[2] * std::cos(tilt) - t.normal[0] * std::sin(tilt)});
  }
  return drawn;
}

TEST(SurfaceErrors, OfTheTruthAreNoneAndOfATiltTheTilt) {
  const double degree = std::acos(-1.0) / 180;
  for (const auto& shape : everyShape()) {
    const TrueSurface surface = trueSurface(*shape, kEye);
    const Errors none = surfaceErrors(surface, drawnOf(surface, 0));
    EXPECT_NEAR(none.mean, 0, 1e-5) << shape->name();
    EXPECT_NEAR(none.depth, 0, 1e-4) << shape->name();
    EXPECT_EQ(none.overlap, 1) << shape->name();
    if (shape->name() != "plane" && !shape->name().starts_with("waves")) continue;  // the others have normals along y, too
    const Errors tilted = surfaceErrors(surface, drawnOf(surface, 3 * degree));
    EXPECT_NEAR(tilted.mean, 3, 1e-6) << shape->name();
    EXPECT_NEAR(tilted.p95, 3, 1e-6) << shape->name();
  }
}

TEST(SurfaceErrors, SilhouettesCountWhatIsMissingAndTooMuch) {
  TrueSurface surface;
  surface.truth.resize(4);
  surface.where = {TrueSurface::Where::Inside, TrueSurface::Where::Inside, TrueSurface::Where::Nowhere, TrueSurface::Where::Nowhere};
  Drawn drawn;
  drawn.depth = {0, INFINITY, 0, INFINITY};
  drawn.normal.resize(4, {0, 0, -1});
  EXPECT_DOUBLE_EQ(surfaceErrors(surface, drawn).overlap, 1.0 / 3);
}

TEST(SurfaceErrors, FlickerLeavesTrueMotionOut) {
  const double degree = std::acos(-1.0) / 180;
  const auto at = [](double traveled) {
    return trueSurface(*traveledWave(kEye.distance, kEye.tangentX, kEye.tangentY, 18, traveled), kEye);
  };
  const TrueSurface before = at(0), after = at(2);
  EXPECT_GT(normalChange(drawnOf(before, 0), drawnOf(after, 0), 10), 1) << "the wave has moved";
  EXPECT_NEAR(errorChange(before, drawnOf(before, 0), after, drawnOf(after, 0)), 0, 1e-5);
  EXPECT_NEAR(errorChange(before, drawnOf(before, 2 * degree), after, drawnOf(after, 2 * degree)), 0, 1e-5) << "the same error moves along";
  EXPECT_NEAR(errorChange(before, drawnOf(before, 2 * degree), after, drawnOf(after, -degree)), 3, 1e-5);
}

}  // namespace
}  // namespace rill::bench
