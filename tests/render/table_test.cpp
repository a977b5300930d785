// The table that a tank stands on above the sea of a clear sky, against rays in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/vector_math.hpp"
#include "render/scenery_rig.hpp"

namespace rill::test {
namespace {

constexpr uint32_t kWidth = 120, kHeight = 80;
constexpr double kFov = 40, kDegree = 3.14159265358979 / 180;
constexpr double kFloor = 0.66, kStone = 0.40;  // red of the albedo
constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kBeyond = 0.15 * 4, kThickness = 0.05 * 4;

/// 4 m by 3 m, open around, so that no glass is before it.
Domain openTank() {
  Domain domain;
  domain.min = {1, 2, 0};
  domain.max = {5, 4, 3};
  domain.open = 0b110011;
  return domain;
}

/// Where a ray enters a box.
struct Entry {
  double at = 0;  // lengths of the ray; infinity: nowhere
  int axis = 1;   // of the normal there
};
Entry entry(const Double3& from, const Double3& ray, const Double3& low, const Double3& high) {
  Entry found;
  double last = kNowhere;
  for (int a = 0; a < 3; ++a) {
    const double one = (low[a] - from[a]) / ray[a], other = (high[a] - from[a]) / ray[a];
    if (std::min(one, other) > found.at) found = {std::min(one, other), a};
    last = std::min(last, std::max(one, other));
  }
  return found.at < last ? found : Entry{kNowhere};
}

/// Red in a uniform environment of 1. It has no sun, so that as much light as from above comes from the direction `toSun`.
double redAlong(const Double3& from, const Double3& ray, const Float3& toSun) {
  const Domain tank = openTank();
  const Entry hit = entry(from, ray, {tank.min.x - kBeyond, tank.min.y - kThickness, tank.min.z - kBeyond},
                          {tank.max.x + kBeyond, tank.min.y, tank.max.z + kBeyond});
  if (hit.at == kNowhere) return 1;
  const Double3 p = along(from, hit.at, ray), sun = {toSun.x, toSun.y, toSun.z};
  const bool inside = hit.axis == 1 && ray.y < 0 && p.x >= tank.min.x && p.x <= tank.max.x && p.z >= tank.min.z && p.z <= tank.max.z;
  const double facing = ray[hit.axis] < 0 ? sun[hit.axis] : -sun[hit.axis];
  return (inside ? kFloor : kStone) * (1 + std::max(facing, 0.0));
}

class TableOnGpu : public SceneryTest {
 protected:
  std::vector<double> draw(const CameraView& camera, const std::string& sky, const std::string& map = {}) {
    Scene scene;
    scene.domain = openTank();
    scene.look.stage = "tank";
    scene.look.sky = sky;
    scene.look.environment = map;
    return SceneryTest::draw(scene, camera, kWidth, kHeight);
  }

  static CameraView from(const Double3& eye) {
    CameraView camera;
    camera.eye = eye;
    camera.target = {3.1, 2.05, 1.4};
    camera.fov_y_deg = kFov;
    return camera;
  }
};

TEST_F(TableOnGpu, IsWhereRaysMeetIt) {
  // From above, from the side just above and below the top, from far below, from above the middle of its side.
  for (const Double3& eye : {Double3{8, 6, 9}, {-4, 2.3, 6}, {9, 1.9, -5}, {3, -3, 5}, {3.1, 4, 8}}) {
    const CameraView camera = from(eye);
    const std::vector<double> drawn = draw(camera, "day");
    const Double3 forward = normalized(minus(camera.target, eye)), right = normalized(cross(forward, {0, 1, 0})),
                  up = cross(right, forward);
    const auto rayAt = [&](double x, double y) {
      const double scale = 2 * std::tan(kFov / 2 * kDegree) / kHeight;
      return along(along(forward, (x - 0.5 * kWidth) * scale, right), (0.5 * kHeight - y) * scale, up);
    };
    size_t compared = 0, table = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const double wanted = redAlong(eye, rayAt(x + 0.5, y + 0.5), toSun_);
        bool even = true;  // rays through the pixel's corners agree
        for (const double dx : {0.1, 0.9})
          for (const double dy : {0.1, 0.9}) even = even && redAlong(eye, rayAt(x + dx, y + dy), toSun_) == wanted;
        if (!even) continue;
        ++compared;
        table += wanted != 1;
        ASSERT_NEAR(drawn[y * kWidth + x], wanted, 0.003) << "eye at y = " << eye.y << ", pixel " << x << ", " << y;
      }
    EXPECT_GT(compared, 0.9 * kWidth * kHeight);
    EXPECT_GT(table, 100u);
  }
}

TEST_F(TableOnGpu, EnvironmentMapHasNone) {
  for (const auto& [sky, map] : {std::pair{"studio", ""}, {"day", "sky.hdr"}}) {
    const std::vector<double> drawn = draw(from({8, 6, 9}), sky, map);
    const double floor = kFloor * (1 + double{toSun_.y});
    for (const double red : drawn) ASSERT_TRUE(std::abs(red - floor) < 0.003 || std::abs(red - 1) < 0.003) << red;
  }
}

}  // namespace
}  // namespace rill::test
