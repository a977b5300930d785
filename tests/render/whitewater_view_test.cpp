// Diffuse particles on the screen: light and shape of dots and streaks.
#include "views/whitewater_view.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "render/look_record.hpp"
#include "render/view_push.hpp"
#include "shared/no_depth.h"
#include "support/gpu_test.hpp"
#include "views/camera.hpp"
#include "views/scenery.hpp"
#include "whitewater/whitewater_records.h"

namespace rill::test {
namespace whitewater_view_test {

constexpr uint32_t kWidth = 320, kHeight = 240;
constexpr float kSpacing = 0.1f;

struct Parcel {
  Float3 position, velocity;
  uint32_t kind = kWhiteSpray;
  uint32_t bits = kWhiteMeanTag;
};

/// Optical depth of the pixels before the fluid: its sum, mean position and second moments about it, in pixels.
struct Moments {
  double light = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  double along(double dx, double dy) const { return (xx * dx * dx + 2 * xy * dx * dy + yy * dy * dy) / (dx * dx + dy * dy); }
};

Moments momentsOf(const std::vector<uint32_t>& dots) {
  Moments m;
  const auto forAll = [&](auto&& visit) {
    for (uint32_t i = 0; i < kWidth * kHeight; ++i)
      if (const double light = double(dots[kWhiteLayers * i]) / double{kWhiteOpacity}; light > 0)
        visit(light, i % kWidth + 0.5, double(i / kWidth) + 0.5);
  };
  forAll([&](double light, double x, double y) { m.light += light, m.x += light * x, m.y += light * y; });
  m.x /= m.light, m.y /= m.light;
  forAll([&](double light, double x, double y) {
    m.xx += light * (x - m.x) * (x - m.x) / m.light;
    m.yy += light * (y - m.y) * (y - m.y) / m.light;
    m.xy += light * (x - m.x) * (y - m.y) / m.light;
  });
  return m;
}

class WhitewaterViewTest : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    bringViewShaders(device());
    auto made = WhitewaterView::create(device(), {}, false);
    ASSERT_TRUE(made) << made.error().message;
    view_ = *made;
  }

  std::vector<uint32_t> dots(const std::vector<Parcel>& parcels, const WhitewaterExposure& exposure, const FluidView& seen,
                             const std::vector<float>& scene = std::vector<float>(kWidth * kHeight, 1e9f)) {
    std::vector<Float4> places;
    std::vector<std::array<uint32_t, 4>> motions;
    for (const Parcel& p : parcels) {
      places.push_back({p.position.x, p.position.y, p.position.z, 0});
      motions.push_back({std::bit_cast<uint32_t>(p.velocity.x), std::bit_cast<uint32_t>(p.velocity.y),
                         std::bit_cast<uint32_t>(p.velocity.z), (p.bits & ~3u) | p.kind});
    }
    std::vector<uint32_t> counts(kWhiteCountWords);
    counts[kWhiteCount] = uint32_t(parcels.size());
    const Buffer place = upload("place", places), motion = upload("motion", motions), count = upload("counts", counts);
    const Buffer none = upload("surface", std::vector<std::array<uint32_t, 2>>(kWidth * kHeight, {kNoDepthBits, 0}));
    Graph graph;
    const surface::SurfacePush push = [&] {
      surface::SurfacePush p = viewPush(seen, {});
      p.spacing = kSpacing;
      return p;
    }();
    std::vector<float> target;  // as the depth target holds the scene
    for (const float z : scene) target.push_back(push.depth_map[0] + push.depth_map[1] * (push.perspective > 0 ? 1 / z : z));
    const Buffer depth = upload("scene depth", target);
    const WhitewaterView::Input input{{graph.import("place", importOf(place)), graph.import("motion", importOf(motion)),
                                       graph.import("counts", importOf(count)), uint32_t(parcels.size())},
                                      {},
                                      graph.import("scene depth", importOf(depth)),
                                      graph.import("surface", importOf(none)),
                                      addLook(graph, lookRecord({}, push, nullptr))};
    const Ticket ticket = graph.readback(view_.addDots(graph, input, push, exposure));
    run(graph);
    return read<uint32_t>(graph, ticket);
  }

  static constexpr CameraView kEye{{1, 2, 5}, {0, 1, 0}, 40};
  static FluidView camera() { return fluidView(kEye, kWidth, kHeight, kSpacing); }
  /// Where the camera shows a point, pixels.
  static std::array<double, 2> pixelOf(const Float3& p) {
    const CameraBasis basis = cameraBasis(kEye);
    const double x = double{p.x} - kEye.eye.x, y = double{p.y} - kEye.eye.y, z = double{p.z} - kEye.eye.z;
    const auto part = [&](const Double3& a) { return x * a.x + y * a.y + z * a.z; };
    const double scale = 0.5 * kHeight / std::tan(0.5 * kEye.fov_y_deg * 3.14159265358979 / 180) / part(basis.forward);
    return {0.5 * kWidth + scale * part(basis.right), 0.5 * kHeight - scale * part(basis.up)};
  }

  WhitewaterView view_;
};

TEST_F(WhitewaterViewTest, StreaksHaveTheLightOfDotsAndTheLengthOfTheirWay) {
  const double seconds = 0.02;
  for (const double size : {0.05, 0.15, 0.3}) {
    const auto seen = [&](const Float3& position, const Float3& velocity) {
      return momentsOf(dots({{position, velocity}}, {.size = size, .seconds = seconds}, camera()));
    };
    for (const Float3 position : {Float3{0, 1, 0}, Float3{0.6f, 1.3f, 1}}) {
      const Moments dot = seen(position, {0, 0, 0});
      for (const Float3 v : {Float3{20, 0, 0}, Float3{0, -15, 0}, Float3{12, 9, 4}, Float3{-3, 2, 1}}) {
        SCOPED_TRACE(testing::Message() << size << " m at " << position.x << ", " << v.x << " " << v.y << " " << v.z << " m/s");
        const auto at = [&](double s) {
          return pixelOf({float(position.x + s * v.x), float(position.y + s * v.y), float(position.z + s * v.z)});
        };
        const auto from = at(-0.5 * seconds), to = at(0.5 * seconds);
        const double dx = to[0] - from[0], dy = to[1] - from[1], length = std::hypot(dx, dy);
        ASSERT_LT(length, double{kWhiteMaxStreakPixels});
        const Moments streak = seen(position, v);
        EXPECT_NEAR(streak.light, dot.light, 0.02 * dot.light);
        EXPECT_NEAR(streak.along(dx, dy) - dot.along(dx, dy), length * length / 12, 0.05 * length * length / 12);
        EXPECT_NEAR(streak.along(-dy, dx), dot.along(-dy, dx), 0.05 * dot.along(-dy, dx));
        EXPECT_NEAR(streak.x, 0.5 * (from[0] + to[0]), 0.1);
        EXPECT_NEAR(streak.y, 0.5 * (from[1] + to[1]), 0.1);
      }
    }
  }
}

TEST_F(WhitewaterViewTest, ParallelRaysAndReversedDepthShowTheSameStreaks) {
  const std::vector<Parcel> parcels{{{0, 1, 0}, {12, 9, 4}}};
  const WhitewaterExposure exposure{.size = 0.15, .seconds = 0.02};
  const FluidView plain = camera();
  FluidView reversed = plain, parallel = plain;
  for (int c = 0; c < 4; ++c) {  // depth d becomes w - d
    Float4& column = reversed.projection.column[c];
    column.z = column.w - column.z;
    // 2 m to the upper edge, and depth from 0 to 1 over 100 m
    parallel.projection.column[c] = {c == 0 ? 0.375f : 0.0f, c == 1 ? -0.5f : 0.0f, c == 2 ? -0.01f : 0.0f, c == 3 ? 1.0f : 0.0f};
  }
  const auto dot = dots(parcels, {.size = 0.15}, parallel), streak = dots(parcels, exposure, parallel);
  EXPECT_NEAR(momentsOf(streak).light, momentsOf(dot).light, 0.02 * momentsOf(dot).light);
  const CameraBasis basis = cameraBasis(kEye);
  const auto along = [&](const Double3& a) { return 60 * 0.02 * (12 * a.x + 9 * a.y + 4 * a.z); };  // 60 pixels a meter
  const double dx = along(basis.right), dy = -along(basis.up), square = dx * dx + dy * dy;
  EXPECT_NEAR(momentsOf(streak).along(dx, dy) - momentsOf(dot).along(dx, dy), square / 12, 0.05 * square / 12);
  EXPECT_NEAR(momentsOf(dots(parcels, exposure, reversed)).light, momentsOf(dots(parcels, exposure, plain)).light, 0.01);
}

TEST_F(WhitewaterViewTest, DimStreaksOfManyDropsKeepTheirLight) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> in(-0.8f, 0.8f), speed(-8, 8);
  std::uniform_int_distribution<uint32_t> bits;
  std::vector<Parcel> moving;
  for (int k = 0; k < 4000; ++k)
    moving.push_back({{in(random), 1 + in(random), in(random)}, {speed(random), speed(random), speed(random)}, kWhiteSpray, bits(random)});
  std::vector<Parcel> still = moving;
  for (Parcel& p : still) p.velocity = {0, 0, 0};
  const WhitewaterExposure exposure{.size = 0.002, .seconds = 0.02};  // a fifteenth of a pixel
  const double expected = momentsOf(dots(still, exposure, camera())).light;
  const auto got = dots(moving, exposure, camera());
  EXPECT_NEAR(momentsOf(got).light, expected, 0.02 * expected);
  EXPECT_EQ(got, dots(moving, exposure, camera())) << "bits are equal from run to run";
}

TEST_F(WhitewaterViewTest, SizesDifferAndKeepTheMeanLight) {
  std::mt19937 random(3);
  std::uniform_int_distribution<uint32_t> bits;
  const WhitewaterExposure exposure{.size = 0.07};
  for (const uint32_t kind : {kWhiteSpray, kWhiteFoam, kWhiteBubble}) {
    const auto light = [&](const std::vector<Parcel>& parcels) { return momentsOf(dots(parcels, exposure, camera())).light; };
    const double mean = light({{{0, 1, 0}, {}, kind}});
    std::vector<Parcel> many;
    for (int k = 0; k < 4000; ++k) many.push_back({{0, 1, 0}, {}, kind, bits(random)});
    // Areas have an exponential distribution, cut at six times their mean.
    EXPECT_NEAR(light(many), 4000 * mean * (1 - std::exp(-6)), 0.05 * 4000 * mean);
    EXPECT_NEAR(light({{{0, 1, 0}, {}, kind, uint32_t(std::exp(-4) * 65536) << 8}}), 4 * mean, 0.05 * 4 * mean);
    EXPECT_NEAR(light({{{0, 1, 0}, {}, kind, uint32_t(std::exp(-0.25) * 65536) << 8}}), 0.25 * mean, 0.15 * 0.25 * mean);
  }
}

TEST_F(WhitewaterViewTest, StreaksAreBounded) {
  for (const auto& [size, bound] : {std::pair{0.05, double{kWhiteMaxStreak} * 1.9}, {0.5, double{kWhiteMaxStreakPixels}}}) {
    const Moments dot = momentsOf(dots({{{0, 1, 0}, {0, 0, 0}}}, {.size = size, .seconds = 1}, camera()));
    const Moments streak = momentsOf(dots({{{0, 1, 0}, {3, 0, 0.3f}}}, {.size = size, .seconds = 1}, camera()));
    const double most = std::sqrt(12 * (streak.along(1, 0) - dot.along(1, 0)));
    EXPECT_NEAR(most, bound, 0.05 * bound);
    EXPECT_NEAR(streak.light, dot.light, 0.02 * dot.light);
  }
}

TEST_F(WhitewaterViewTest, FoamBubblesAndSprayThatMovesWithTheCameraAreRound) {
  const WhitewaterExposure exposure{.size = 0.15, .seconds = 0.02, .turn = {0, 2, 0}, .about = {0.5, 0, -0.2}};
  const auto still = [&](uint32_t kind) { return dots({{{0, 1, 0}, {0, 0, 0}, kind}}, {.size = 0.15}, camera()); };
  for (const uint32_t kind : {kWhiteFoam, kWhiteBubble}) EXPECT_EQ(dots({{{0, 1, 0}, {9, 3, 0}, kind}}, exposure, camera()), still(kind));
  // The velocity of a point fixed to the camera: turn x (position - about)
  EXPECT_EQ(dots({{{0, 1, 0}, {0.4f, 0, 1}}}, exposure, camera()), still(kWhiteSpray));
  EXPECT_NE(dots({{{0, 1, 0}, {0, 0, 0}}}, exposure, camera()), still(kWhiteSpray));
}

TEST_F(WhitewaterViewTest, SceneHidesThePartOfAStreakBehindIt) {
  // Towards the eye and across: the nearer half is before a wall through the middle
  const Parcel parcel{{0, 1, 0}, {10, 0, 20}};
  const WhitewaterExposure exposure{.size = 0.15, .seconds = 0.04};
  const Double3 forward = cameraBasis(kEye).forward;
  const auto depth = static_cast<float>(-forward.x * kEye.eye.x - forward.y * (kEye.eye.y - 1) - forward.z * kEye.eye.z);
  const Moments whole = momentsOf(dots({parcel}, exposure, camera()));
  const Moments half = momentsOf(dots({parcel}, exposure, camera(), std::vector<float>(kWidth * kHeight, depth)));
  EXPECT_NEAR(half.light, 0.5 * whole.light, 0.05 * whole.light);
  EXPECT_GT(half.x, whole.x + 3);
}

}  // namespace whitewater_view_test
}  // namespace rill::test
