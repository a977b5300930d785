// Diffuse particles among solids.
#include "support/meshes.hpp"
#include "whitewater/whitewater_fixture.hpp"

namespace rill::test {
namespace whitewater_test {

WhiteSolid solidOf(Shape shape, const Pose& pose, double spacing = 0.05) {
  WhiteSolid solid{std::move(shape), pose};
  const auto* mesh = std::get_if<MeshShape>(&solid.shape);
  if (!mesh) return solid;
  auto field = MeshField::create(*mesh->mesh, SmoothingKernel(KernelChoice::Wendland, 2 * spacing, spacing));
  EXPECT_TRUE(field);
  solid.field = std::make_shared<MeshField>(*std::move(field));
  return solid;
}

Shape boxShape() { return BoxShape{{-0.2, -0.1, -0.15}, {0.2, 0.1, 0.15}}; }
Shape ballShape() { return SphereShape{{0, 0, 0}, 0.15}; }
Shape meshShape() { return MeshShape{.mesh = meshOf(joined(ballMesh(0.15, 3), boxMesh({-0.25, -0.06, -0.07}, {0.25, 0.06, 0.07})))}; }

TEST_F(WhitewaterTest, SolidsMatchReferenceOfRandomInput) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> in(-0.2, 0.8), speed(-4, 4), age(0, 2);
  const Pose still{{0.3, 0.25, 0.25}, {0, 0.6, 0, 0.8}}, moving{{0.3, 0.2, 0.25}, {0, 0, 0.6, 0.8}, {1, 0.5, -2}, {2, -1, 4}};
  for (const Shape& shape : {boxShape(), ballShape(), meshShape()})
    for (const Pose& pose : {still, moving}) {
      SCOPED_TRACE(testing::Message() << shape.index() << " at " << pose.velocity.x << " m/s");
      WhiteFluid fluid = block(
          0.05, {0.6, 0.4, 0.5}, [&](const dvec3& x) { return dvec3(2 + x.y, 3 - 4 * x.x, speed(random)); }, 0.2);
      fluid.solids = {solidOf(shape, pose), solidOf(SphereShape{{0, 0, 0}, 0.1}, {{0.7, 0.1, 0.1}})};
      std::erase_if(fluid.positions, [&](const dvec3& x) { return reference::whiteDistance(fluid.solids[0], x).distance < 0.02; });
      fluid.velocities.resize(fluid.positions.size());
      std::vector<WhiteParticle> particles;
      while (particles.size() < 3000) {
        const dvec3 x(in(random), in(random), in(random));
        const auto k = uint32_t(particles.size());
        const double away = reference::whiteDistance(fluid.solids[0], x).distance;
        if (away < 0.002 || (k % 2 == 1 && away > 0.04)) continue;
        if (reference::whiteDistance(fluid.solids[1], x).distance < 0) continue;
        particles.push_back({x, {speed(random), speed(random), speed(random)}, age(random), k << 2 | k % 3});
      }
      const WhitewaterSnapshot start = snapshotOf(particles);
      const bool mesh = shape.index() == 2;
      const WhitewaterDesc desc{.capacity = uint32_t(fluid.positions.size()),
                                .room = 20'000,
                                .parcel_m3 = 4e-7,
                                .domain = Domain{.min = {-0.1, 0, -0.1}, .max = {1, 2, 0.6}},
                                .solids = 2,
                                .meshes = mesh,
                                .snapshot = &start};
      Whitewater white = create(desc);
      const double seconds = 0.02;
      const WhitewaterSnapshot made = step(white, fluid, seconds);
      const size_t kept = particles.size() - size_t(whitewaterStats(made.counts).dissolved);
      const auto expected = reference::whiteAdvance(particles, fluid, desc, seconds);
      EXPECT_GT(std::ranges::count_if(expected,
                                      [&](const WhiteParticle& p) {
                                        return reference::whiteDistance(fluid.solids[0], p.position).distance < 0.02 * fluid.spacing;
                                      }),
                10)
          << "on the surface";
      // The device stops before a mesh at 1e-4 of its size
      const double tolerance = mesh ? 1e-3 : 1e-4;
      const size_t few = mesh ? 4 : 0;
      expectLikeReference(made, 0, kept, expected, tolerance, few);
      const auto births = reference::whiteBirths(fluid, desc, seconds, 0);
      EXPECT_GT(births.size(), 500u);
      expectLikeReference(made, kept, made.place.size() - kept, births, tolerance, few);
    }
}

TEST_F(WhitewaterTest, NoParticleIsInsideAMovingSolid) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> in(0, 1), push(-1, 1);
  for (const Shape& shape : {boxShape(), ballShape(), meshShape()}) {
    SCOPED_TRACE(shape.index());
    Pose pose{{0.3, 0.2, 0.25}};
    WhitewaterDesc desc{.capacity = 1200,
                        .room = 3000,
                        .parcel_m3 = 2e-6,
                        .domain = Domain{.min = {-1, -1, -1}, .max = {2, 2, 2}},
                        .solids = 1,
                        .meshes = shape.index() == 2};
    Whitewater white = create(desc);
    WhitewaterStats stats;
    size_t touching = 0;
    constexpr double kSeconds = 0.02;
    for (int k = 0; k < 100; ++k) {
      pose.velocity = {2 * push(random), 2 * push(random), 2 * push(random)};
      pose.angularVelocity = {6 * push(random), 6 * push(random), 6 * push(random)};
      pose.center = {pose.center.x + kSeconds * pose.velocity.x, pose.center.y + kSeconds * pose.velocity.y,
                     pose.center.z + kSeconds * pose.velocity.z};
      pose.rotation = turned(pose.rotation, kSeconds, pose.angularVelocity);
      WhiteFluid fluid{.spacing = 0.05, .solids = {solidOf(shape, pose)}};
      while (fluid.positions.size() < 1000) {
        const dvec3 x(0.8 * in(random), 0.5 * in(random), 0.6 * in(random));
        if (reference::whiteDistance(fluid.solids[0], x).distance < 0.025) continue;
        fluid.positions.push_back(x);
        fluid.velocities.push_back({4 * push(random), 4 * push(random), 4 * push(random)});
      }
      const WhitewaterSnapshot made = step(white, fluid, kSeconds);
      stats = whitewaterStats(made.counts);
      for (const Float4& p : made.place) {
        const double away = reference::whiteDistance(fluid.solids[0], {p.x, p.y, p.z}).distance;
        ASSERT_GT(away, 0) << "step " << k;
        touching += away < 0.02 * fluid.spacing ? 1 : 0;
      }
    }
    EXPECT_GT(stats.dissolved, 1000u);
    EXPECT_GT(stats.foam + stats.bubbles, 300u);
    EXPECT_GT(touching, 100u) << "in all steps";
    EXPECT_EQ(stats.boundHits, 0u);
  }
}

TEST_F(WhitewaterTest, FastSprayDoesNotTunnelThroughPlates) {
  std::vector<WhiteParticle> particles;
  for (uint32_t k = 0; k < 100; ++k)
    particles.push_back({{0.02 + 0.01 * (k % 10), 0.3, 0.01 * k - 0.5}, {30, 0, 0}, 0, k << 2 | kWhiteSpray});
  const WhitewaterSnapshot start = snapshotOf(particles);
  WhiteFluid fluid{{{5, 5, 5}}, {{0, 0, 0}}, 0.05};
  fluid.solids = {solidOf(BoxShape{{-0.001, -1, -0.245}, {0.001, 1, 0.255}}, {{0.4, 0, 0}})};
  for (const bool moves : {false, true}) {
    if (moves)  // the plate comes the other way: they meet
      fluid.solids[0].pose = {{-0.2, 0, 0}, {0, 0, 0, 1}, {-30, 0, 0}};
    Whitewater white = create({.capacity = 1, .room = 100, .parcel_m3 = 1, .gravity = {0, 0, 0}, .solids = 1, .snapshot = &start});
    EXPECT_EQ(step(white, fluid, 0.02).place.size(), 50u) << "those beside the plate fly on";
  }
}

TEST_F(WhitewaterTest, SolidFarAwayChangesNoBit) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 1);
  WhiteFluid fluid = block(
      0.05, {0.5, 0.4, 0.5}, [&](const dvec3&) { return dvec3(2 + noise(random), noise(random), noise(random)); }, 0.3);
  WhitewaterDesc desc{.capacity = uint32_t(fluid.positions.size()), .room = 5000, .parcel_m3 = 1e-5};
  Whitewater without = create(desc);
  const WhitewaterSnapshot expected = step(without, fluid, 0.02, 3);
  ASSERT_GT(expected.place.size(), 100u);
  fluid.solids = {solidOf(ballShape(), {{30, 0, 0}})};
  desc.solids = 1;
  Whitewater with = create(desc);
  EXPECT_TRUE(step(with, fluid, 0.02, 3) == expected);
}

}  // namespace whitewater_test
}  // namespace rill::test
