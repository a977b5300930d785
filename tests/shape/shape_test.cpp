#include "shape/shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shape/pose.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace {

const Shape kShapes[] = {BoxShape{{1, 2, 3}, {1.4, 3, 4.6}}, SphereShape{{1, 2, 3}, 0.7},
                         MeshShape{.mesh = meshOf(boxMesh({-0.3, 0.1, -0.8}, {0.4, 0.9, 0.2}))}};

/// Points and directions in a cube of 4 m.
class Points {
 public:
  Double3 next() { return {place_(random_), place_(random_), place_(random_)}; }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> place_{-2, 2};
};

TEST(Shape, NormalIsTheGradientOfTheDistance) {
  Points points;
  for (const Shape& shape : kShapes) {
    for (int n = 0; n < 500; ++n) {
      const Double3 x = points.next();
      const SurfacePoint at = surfaceAt(shape, x);
      for (size_t a = 0; a < 3; ++a) {
        Double3 low = x, high = x;
        low[a] -= 1e-7, high[a] += 1e-7;
        EXPECT_NEAR(at.normal[a], (surfaceAt(shape, high).distance - surfaceAt(shape, low).distance) / 2e-7, 1e-5);
      }
      Double3 foot = x;  // outside: the closest point is on the surface
      for (size_t a = 0; a < 3; ++a) foot[a] -= at.distance * at.normal[a];
      EXPECT_NEAR(surfaceAt(shape, foot).distance, 0, 1e-12);
    }
  }
}

TEST(Shape, BoundsHoldWhatIsInside) {
  Points points;
  const Pose pose{.center = {0, 0, 0}, .rotation = {0.5, 0.5, -0.5, 0.5}};
  for (const Shape& shape : kShapes) {
    const Double3 half = halfExtents(shape), middle = middleOf(shape);
    const SceneBox box = sceneBox(shape, pose);
    size_t inside = 0;
    Double3 low = box.high, high = box.low;
    for (int n = 0; n < 20000; ++n) {
      const Double3 x = points.next();
      if (surfaceAt(shape, pose, x).distance > 0) continue;
      ++inside;
      EXPECT_LE(std::hypot(x[0], x[1], x[2]), boundingRadius(shape));
      const Double3 local = localPoint(pose, x);
      for (size_t a = 0; a < 3; ++a) {
        EXPECT_LE(std::abs(local[a] - middle[a]), half[a]);
        low[a] = std::min(low[a], x[a]);
        high[a] = std::max(high[a], x[a]);
      }
    }
    for (size_t a = 0; a < 3; ++a) {
      EXPECT_GE(low[a], box.low[a] - 1e-12);
      EXPECT_LE(high[a], box.high[a] + 1e-12);
      EXPECT_GT(high[a] - low[a], 0.8 * (box.high[a] - box.low[a]));
    }
    const double volume = std::visit([](const auto& s) { return volumeOf(s); }, shape);
    EXPECT_NEAR(64.0 * static_cast<double>(inside) / 20000, volume, 0.15 * volume) << "of so many random points";
  }
}

TEST(Shape, RaysEnterAtTheSurface) {
  Points points;
  for (const Shape& shape : kShapes) {
    size_t hits = 0;
    for (int n = 0; n < 2000; ++n) {
      const Double3 from = points.next();
      Double3 along = points.next();
      const double length = std::hypot(along[0], along[1], along[2]);
      for (double& a : along) a /= length;
      const auto entry = rayEntry(shape, from, along);
      if (surfaceAt(shape, from).distance < 0) {
        EXPECT_FALSE(entry) << "from inside";
      } else if (entry) {
        ++hits;
        const auto at = [&](double t) {
          return surfaceAt(shape, {from[0] + t * along[0], from[1] + t * along[1], from[2] + t * along[2]});
        };
        EXPECT_NEAR(at(*entry).distance, 0, 1e-12);
        for (int k = 0; k < 10; ++k) EXPECT_GT(at(*entry * k / 10).distance, -1e-12) << "nothing before it";
      } else {
        for (int k = 0; k < 100; ++k) {
          const double t = 0.06 * k;
          EXPECT_GT(surfaceAt(shape, {from[0] + t * along[0], from[1] + t * along[1], from[2] + t * along[2]}).distance, -1e-12);
        }
      }
    }
    EXPECT_GT(hits, 50u);
  }
}

TEST(Shape, TranslatesItsCenter) {
  for (const Shape& shape : kShapes) {
    Solid solid{.shape = shape};
    const Double3 before = centerOf(solid);
    translate(solid, {1, -2, 3});
    const Double3 after = centerOf(solid);
    EXPECT_DOUBLE_EQ(after[0] - before[0], 1);
    EXPECT_DOUBLE_EQ(after[1] - before[1], -2);
    EXPECT_DOUBLE_EQ(after[2] - before[2], 3);
  }
}

}  // namespace
}  // namespace rill::test
