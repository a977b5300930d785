// Pictures of particles against geometry in double precision.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "render/particle_view_rig.hpp"

namespace rill::test {
namespace particle_view_test {

TEST_F(ParticleViewOnGpu, OutlinesMatchGeometry) {
  constexpr uint32_t kWidth = 200, kHeight = 120;
  const Picture empty = take({}, kWidth, kHeight);
  // Near and large (the tiled kernel), far and small, off the axis where the outline is an ellipse, cut by the picture's border.
  for (const Particle& p :
       {Particle{0.4f, -0.3f, -2}, Particle{1, 1, -8}, Particle{-5.5f, 2.6f, -7}, Particle{7, -3, -8.2f}, Particle{0.1f, 0, -1.1f}}) {
    const Picture picture = take({p}, kWidth, kHeight);
    const double pixel = std::abs(p.z) / (0.5 * kHeight / kTangent) / 0.5;  // of a radius
    size_t covered = 0;
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const double depth = inside(p, 0.5, x + 0.5, y + 0.5, kWidth, kHeight);
        const bool drawn = picture.at(x, y) != empty.at(x, y);
        covered += drawn ? 1 : 0;
        if (depth > 0.02 * pixel) { EXPECT_TRUE(drawn) << x << ' ' << y << " of the sphere at z " << p.z; }
        if (depth < -1.5 * pixel) { EXPECT_FALSE(drawn) << x << ' ' << y << " of the sphere at z " << p.z; }
      }
    }
    EXPECT_GT(covered, 20u);
  }
}

TEST_F(ParticleViewOnGpu, NearestSphereOwnsThePixel) {
  constexpr uint32_t kWidth = 160, kHeight = 160;
  // Two that intersect: the boundary is where their depths along the ray are equal.
  const Particle a{-0.2f, 0, -3, 0, 0, 0}, b{0.25f, 0, -3.1f, 1, 0, 0};
  const Picture both = take({a, b}, kWidth, kHeight), onlyA = take({a, {100, 0, 50, 1}}, kWidth, kHeight),
                onlyB = take({{100, 0, 50}, b}, kWidth, kHeight);
  const double focal = 0.5 * kHeight / kTangent;
  const auto depth = [&](const Particle& p, uint32_t x, uint32_t y) {
    const Double3 d = {(x + 0.5 - 0.5 * kWidth) / focal, (0.5 * kHeight - y - 0.5) / focal, -1};
    const double dd = d[0] * d[0] + d[1] * d[1] + 1, dp = d[0] * p.x + d[1] * p.y + d[2] * p.z;
    const double square = dp * dp - dd * (double{p.x} * p.x + double{p.y} * p.y + double{p.z} * p.z - 0.25);
    return square < 0 ? std::numeric_limits<double>::infinity() : (dp - std::sqrt(square)) / dd;
  };
  // Hue tells them apart: ambient occlusion may shade either.
  const auto blueness = [](uint32_t p) { return (static_cast<double>((p >> 16) & 255) + 1) / (static_cast<double>(p & 255) + 1); };
  size_t compared = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const double da = depth(a, x, y), db = depth(b, x, y);
      const double wellInside =
          std::min(inside(a, 0.5, x + 0.5, y + 0.5, kWidth, kHeight), inside(b, 0.5, x + 0.5, y + 0.5, kWidth, kHeight));
      if (wellInside < 0.12 || std::abs(da - db) < 0.02) continue;
      ++compared;
      const double seen = std::log(blueness(both.at(x, y))), asA = std::log(blueness(onlyA.at(x, y))),
                   asB = std::log(blueness(onlyB.at(x, y)));
      EXPECT_EQ(std::abs(seen - asA) < std::abs(seen - asB), da < db) << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, 100u);
}

TEST_F(ParticleViewOnGpu, CullsInvisibleParticles) {
  constexpr uint32_t kSize = 96;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Particle seen{0, 0, -6};
  const Particle nowhere[] = {{0, 0, 6},     {nan, 0, -6},   {0, nan, -6},
                              {0, 0, nan},   {inf, 0, -6},   {0, 0, -inf},
                              {0, -inf, -6}, {3e38f, 0, -6}, {-3e38f, 3e38f, -3e38f},
                              {40, 0, -6},   {0, 0, 0.6f}};
  start_ = {0, 0, -6};
  const Picture alone = take({seen, seen, seen, seen, seen, seen, seen, seen, seen, seen, seen, seen}, kSize, kSize);
  std::vector<Particle> all(std::begin(nowhere), std::end(nowhere));
  all.push_back(seen);
  EXPECT_EQ(difference(take(all, kSize, kSize), alone), 0u);
}

TEST_F(ParticleViewOnGpu, HugeSpheresTakeBoundedLoops) {
  constexpr uint32_t kWidth = 700, kHeight = 500;
  const Picture empty = take({}, kWidth, kHeight);
  // One that covers everything; behind a large one, a small one is hidden.
  scene_.fluid.spacing = 1000;
  const Particle cover{0, 0, -600};
  const Picture huge = take({cover, cover}, kWidth, kHeight);
  EXPECT_EQ(difference(huge, empty), huge.pixels.size());
  EXPECT_EQ(difference(take({cover, {0, 0, -2600}}, kWidth, kHeight), huge), 0u);
  // The eye inside a sphere, and many spheres that cross the near plane.
  scene_.fluid.spacing = 1;
  std::vector<Particle> crowd;
  for (int k = 0; k < 2000; ++k) {
    crowd.push_back(
        {0.04f * static_cast<float>(k % 50 - 25), 0.04f * static_cast<float>(k / 50 % 50 - 25), -0.4f * static_cast<float>(k % 7)});
  }
  take(crowd, 200, 120);
}

TEST_F(ParticleViewOnGpu, DistantParticlesStayVisible) {
  // Each is less than a hundredth of a pixel wide, and drawn one pixel wide.
  constexpr uint32_t kSize = 64;
  const Picture empty = take({}, kSize, kSize);
  for (const float x : {0.0f, 3000.0f, 12345.0f}) {
    const Picture picture = take({{x, 0, -100000}}, kSize, kSize);
    const size_t changed = difference(picture, empty);
    EXPECT_GE(changed, 1u) << x;
    EXPECT_LE(changed, 9u) << x;
  }
}

TEST_F(ParticleViewOnGpu, NearestOfACloudMatchesReference) {
  // Thousands, most of them hidden and culled, against every sphere tested for every pixel. Slow ones are blue, fast ones pale.
  constexpr uint32_t kWidth = 192, kHeight = 108;
  scene_.fluid.spacing = 0.2;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<Particle> cloud;
  for (int k = 0; k < 4000; ++k)
    cloud.push_back({2.2f * unit(random), 1.3f * unit(random), -3.6f + unit(random), 0, k % 2 ? 1.0f : 0.0f, 0});
  const Picture picture = take(cloud, kWidth, kHeight), empty = take({}, kWidth, kHeight);
  const double focal = 0.5 * kHeight / kTangent;
  size_t compared = 0, wrong = 0, bare = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const Double3 d = {(x + 0.5 - 0.5 * kWidth) / focal, (0.5 * kHeight - y - 0.5) / focal, -1};
      const double dd = d[0] * d[0] + d[1] * d[1] + 1;
      double nearest[2] = {1e9, 1e9}, rim = 0;  // of either kind; how far inside of the outline the hit is
      bool beside = false;                      // an outline of a nearer one is close
      for (size_t k = 0; k < cloud.size(); ++k) {
        const Particle& p = cloud[k];
        const double t = (d[0] * p.x + d[1] * p.y - p.z) / dd;
        const double off = std::hypot(p.x - t * d[0], p.y - t * d[1], p.z + t) / 0.1;
        if (off > 1.4) continue;
        const double depth = t - 0.1 * std::sqrt(std::max(1 - off * off, 0.0) / dd);
        if (off > 1 || depth < 0) continue;
        double& best = nearest[k % 2];
        if (depth < std::min(nearest[0], nearest[1])) rim = 1 - off;
        best = std::min(best, depth);
      }
      const double first = std::min(nearest[0], nearest[1]);
      for (size_t k = 0; k < cloud.size() && !beside; ++k) {
        const Particle& p = cloud[k];
        const double t = (d[0] * p.x + d[1] * p.y - p.z) / dd;
        const double off = std::hypot(p.x - t * d[0], p.y - t * d[1], p.z + t) / 0.1;
        beside = off >= 1 && off < 1.7 && t < first + 0.1;
      }
      if (beside) continue;
      if (first > 1e8) {
        bare += picture.at(x, y) == empty.at(x, y) ? 1 : 0;
        wrong += picture.at(x, y) != empty.at(x, y) ? 1 : 0;
      } else if (rim > 0.4 && std::abs(nearest[0] - nearest[1]) > 0.01) {
        const uint32_t pixel = picture.at(x, y);
        const bool pale = 1.45 * (pixel & 255) > ((pixel >> 16) & 255);
        ++compared;
        wrong += pale != (nearest[1] < nearest[0]) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(compared, 300u);
  EXPECT_GT(bare, 100u);
}

TEST_F(ParticleViewOnGpu, EmptyTankHasFloorWallsAndEdges) {
  constexpr uint32_t kWidth = 320, kHeight = 180;
  const Picture nothing = take({}, kWidth, kHeight);
  scene_.domain = Domain{{0, 0, 0}, {2, 1, 1}, 0};
  camera_ = frameCamera(scene_.domain->min, scene_.domain->max, static_cast<double>(kWidth) / kHeight);
  const Picture tank = take({}, kWidth, kHeight);
  EXPECT_GT(difference(tank, nothing), tank.pixels.size() / 4);
  // Corners of the picture are background.
  EXPECT_EQ(tank.at(0, 0), nothing.at(0, 0));
  EXPECT_EQ(tank.at(kWidth - 1, kHeight - 1), nothing.at(kWidth - 1, kHeight - 1));
  // Without the floor it looks different, without a back wall too.
  scene_.domain->open = 1 << 2;
  const Picture noFloor = take({}, kWidth, kHeight);
  EXPECT_GT(difference(tank, noFloor), tank.pixels.size() / 20);
  scene_.domain->open = 1 << 4;
  EXPECT_GT(difference(tank, take({}, kWidth, kHeight)), tank.pixels.size() / 20);
}

TEST_F(ParticleViewOnGpu, SolidsOccludeParticlesAndMove) {
  constexpr uint32_t kSize = 128;
  Solid box;
  box.shape = BoxShape{{-1, -1, -6}, {1, 1, -5}};
  box.motion = {{0, {0, 0, 0}}, {1, {30, 0, 0}}};
  scene_.solids = {box};
  const Particle behind{0, 0, -8}, before{0, 0, -3}, far{100, 100, 50};
  const Picture bare = take({far}, kSize, kSize), hidden = take({behind}, kSize, kSize), seen = take({before}, kSize, kSize);
  EXPECT_EQ(difference(bare, hidden), 0u);
  EXPECT_GT(difference(bare, seen), 500u);
  // At 1 s the box is out of the picture, in between half way.
  scene_.solids.clear();
  const Picture open = take({behind}, kSize, kSize);
  scene_.solids = {box};
  EXPECT_EQ(difference(take({behind}, kSize, kSize, 1), open), 0u);
  EXPECT_EQ(difference(take({behind}, kSize, kSize, 7), open), 0u) << "the last keyframe holds";
  EXPECT_EQ(difference(take({behind}, kSize, kSize, -1), hidden), 0u) << "and the first";
  EXPECT_GT(difference(take({behind}, kSize, kSize, 0.05), hidden), 100u);
}

TEST_F(ParticleViewOnGpu, ManySolidsOfBothKinds) {
  // More than one word of a tile's mask; each sphere is where it must be.
  constexpr uint32_t kWidth = 256, kHeight = 128;
  const Picture empty = take({}, kWidth, kHeight);
  std::vector<std::pair<double, double>> centers;
  for (int k = 0; k < 100; ++k) {
    Solid solid;
    const double x = 0.8 * (k % 20 - 9.5), y = 0.8 * (k / 20 - 2);
    if (k % 2 == 0)
      solid.shape = SphereShape{{x, y, -10}, 0.2};
    else
      solid.shape = BoxShape{{x - 0.12, y - 0.12, -10.1}, {x + 0.12, y + 0.12, -9.9}};
    scene_.solids.push_back(solid);
    centers.emplace_back(x, y);
  }
  const Picture picture = take({}, kWidth, kHeight);
  const double scale = 0.5 * kHeight / kTangent / 10;
  for (const auto& [x, y] : centers) {
    const double px = 0.5 * kWidth + x * scale, py = 0.5 * kHeight - y * scale;
    EXPECT_NE(picture.at(static_cast<uint32_t>(px), static_cast<uint32_t>(py)),
              empty.at(static_cast<uint32_t>(px), static_cast<uint32_t>(py)));
    const double gap = px + 0.4 * scale;
    if (gap < kWidth) {
      EXPECT_EQ(picture.at(static_cast<uint32_t>(gap), static_cast<uint32_t>(py)),
                empty.at(static_cast<uint32_t>(gap), static_cast<uint32_t>(py)));
    }
  }
}

TEST_F(ParticleViewOnGpu, PictureDoesNotDependOnTheOrigin) {
  constexpr uint32_t kSize = 100;
  const std::vector<Particle> particles = {{0.3f, 0.2f, -4}, {-1, 0.5f, -6, 2, 0, 0}};
  scene_.domain = Domain{{-2, -2, -10}, {2, 2, -1}, 0};
  const Picture here = take(particles, kSize, kSize);
  for (int a = 0; a < 3; ++a) {
    origin_[a] = 1e7;
    camera_.eye[a] += 1e7;
    camera_.target[a] += 1e7;
    scene_.domain->min[a] += 1e7;
    scene_.domain->max[a] += 1e7;
  }
  EXPECT_EQ(difference(take(particles, kSize, kSize), here), 0u);
}

TEST_F(ParticleViewOnGpu, HandlesTinyAndOddSizes) {
  scene_.domain = Domain{{-1, -1, -5}, {1, 1, -3}, 0};
  for (const auto& [width, height] : {std::pair{1u, 1u}, std::pair{3u, 17u}, std::pair{257u, 9u}}) {
    const Picture picture = take({{0, 0, -4}}, width, height);
    for (const uint32_t pixel : picture.pixels) EXPECT_EQ(pixel >> 24, 255u);
  }
}

}  // namespace particle_view_test
}  // namespace rill::test
