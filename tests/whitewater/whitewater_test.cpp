// Diffuse particles on the device against the reference in double precision, and what must hold of any.
#include "rill/whitewater.hpp"

#include <bit>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <random>

#include "reference/whitewater.hpp"
#include "shape/records.hpp"
#include "sph/mesh_field.hpp"
#include "support/gpu_test.hpp"
#include "support/meshes.hpp"
#include "whitewater/whitewater_records.h"

namespace rill::test {
namespace {

using glm::dvec3;
using reference::WhiteFluid;
using reference::WhiteParticle;
using reference::WhiteSolid;

Float3 velocityOf(const std::array<uint32_t, 4>& motion) {
  return {std::bit_cast<float>(motion[0]), std::bit_cast<float>(motion[1]), std::bit_cast<float>(motion[2])};
}

class WhitewaterTest : public GpuTest {
 protected:
  Whitewater create(const WhitewaterDesc& desc) {
    auto made = Whitewater::create(device(), desc);
    EXPECT_TRUE(made) << made.error().message;
    return *std::move(made);
  }
  /// Steps of equal length past the same fluid.
  WhitewaterSnapshot step(Whitewater& white, const WhiteFluid& fluid, double seconds, int steps = 1) {
    std::vector<Float4> position, velocity;
    for (const auto& p : fluid.positions) position.push_back({float(p.x), float(p.y), float(p.z), 7});
    for (const auto& v : fluid.velocities) velocity.push_back({float(v.x), float(v.y), float(v.z), 1});
    const auto count = static_cast<uint32_t>(position.size());
    const Buffer positions = upload("position", position.empty() ? std::vector<Float4>(1) : position);
    const Buffer velocities = upload("velocity", velocity.empty() ? std::vector<Float4>(1) : velocity);
    std::vector<SolidRecord> solids;
    std::vector<uint32_t> words;
    for (const WhiteSolid& solid : fluid.solids) {
      SolidRecord& record = solids.emplace_back();
      record.shape = recordOf(solid.shape);
      record.pose = recordOf(solid.pose, {});
      record.radius = static_cast<float>(boundingRadius(solid.shape));
      record.body = kNoBody;
      if (!solid.field) continue;
      record.shape.field = static_cast<uint32_t>(words.size());
      words.insert(words.end(), solid.field->words().begin(), solid.field->words().end());
    }
    const Buffer records = upload("solids", solids.empty() ? std::vector<SolidRecord>(1) : solids);
    const Buffer fields = upload("fields", words.empty() ? std::vector<uint32_t>(1) : words);
    Graph graph;
    Ticket tickets[3];
    for (int k = 0; k < steps; ++k) {
      graph.reset();
      FluidState state;
      state.capacity = count;
      state.spacing = static_cast<float>(fluid.spacing);
      state.position = graph.import("position", importOf(positions));
      state.velocity = graph.import("velocity", importOf(velocities));
      if (!solids.empty()) {
        state.boundaries = graph.import("solids", importOf(records));
        if (!words.empty()) state.meshWords = graph.import("fields of meshes", importOf(fields));
      }
      const WhitewaterState made = white.addTo(graph, state, seconds);
      tickets[0] = graph.readback(made.counts);
      if (k + 1 == steps) {
        tickets[1] = graph.readback(made.place);
        tickets[2] = graph.readback(made.motion);
      }
      run(graph);
    }
    WhitewaterSnapshot after;
    after.counts = read<uint32_t>(graph, tickets[0]);
    after.place = read<Float4>(graph, tickets[1]);
    after.motion = read<std::array<uint32_t, 4>>(graph, tickets[2]);
    if (after.counts.empty() || after.counts[kWhiteCount] > after.place.size()) {
      ADD_FAILURE() << "no counts";
      return {};
    }
    after.place.resize(after.counts[kWhiteCount]);
    after.motion.resize(after.counts[kWhiteCount]);
    return after;
  }
};

WhiteFluid block(double spacing, const dvec3& size, const std::function<dvec3(const dvec3&)>& velocity, double jitter = 0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-jitter * spacing, jitter * spacing);
  WhiteFluid fluid{.spacing = spacing};
  for (int i = 0; i < std::lround(size.x / spacing); ++i)
    for (int j = 0; j < std::lround(size.y / spacing); ++j)
      for (int k = 0; k < std::lround(size.z / spacing); ++k) {
        const dvec3 x = spacing * dvec3(i + 0.5, j + 0.5, k + 0.5) + dvec3(off(random), off(random), off(random));
        fluid.positions.push_back(x);
        fluid.velocities.push_back(velocity(x));
      }
  return fluid;
}

WhiteFluid ball(double spacing, double radius, const std::function<dvec3(const dvec3&)>& velocity) {
  WhiteFluid fluid{.spacing = spacing};
  const int n = static_cast<int>(radius / spacing) + 1;
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k)
        if (const dvec3 x = spacing * dvec3(i + 0.5, j + 0.5, k + 0.5); glm::length(x) < radius) {
          fluid.positions.push_back(x);
          fluid.velocities.push_back(velocity(x));
        }
  return fluid;
}

WhitewaterSnapshot snapshotOf(const std::vector<WhiteParticle>& particles) {
  WhitewaterSnapshot s;
  s.counts.assign(kWhiteCountWords, 0);
  s.counts[kWhiteCount] = static_cast<uint32_t>(particles.size());
  for (const WhiteParticle& p : particles) {
    s.place.push_back({float(p.position.x), float(p.position.y), float(p.position.z), float(p.age)});
    s.motion.push_back({std::bit_cast<uint32_t>(float(p.velocity.x)), std::bit_cast<uint32_t>(float(p.velocity.y)),
                        std::bit_cast<uint32_t>(float(p.velocity.z)), p.tag});
  }
  return s;
}

/// Compares particles by their random bits, in order. A few may differ: where a share or a number is close to a threshold.
void expectLikeReference(const WhitewaterSnapshot& made, size_t from, size_t count, const std::vector<WhiteParticle>& expected,
                         double tolerance, size_t few = 0) {
  std::multimap<uint32_t, size_t> byTag;
  for (size_t k = 0; k < expected.size(); ++k) byTag.emplace(expected[k].tag >> 2, k);
  size_t missing = 0, kinds = 0, far = 0, last = 0, unordered = 0;
  for (size_t k = from; k < from + count; ++k) {
    const auto found = byTag.find(made.motion[k][3] >> 2);
    if (found == byTag.end()) {
      ++missing;
      continue;
    }
    const WhiteParticle& p = expected[found->second];
    unordered += found->second < last ? 1 : 0;
    last = found->second;
    if ((p.tag & 3) != (made.motion[k][3] & 3)) {
      ++kinds;
      continue;
    }
    const Float3 v = velocityOf(made.motion[k]);
    const dvec3 x(made.place[k].x, made.place[k].y, made.place[k].z);
    far += glm::length(x - p.position) > tolerance || glm::length(dvec3(v.x, v.y, v.z) - p.velocity) > 100 * tolerance ||
                   std::abs(double{made.place[k].w} - p.age) > 1e-5
               ? 1
               : 0;
  }
  EXPECT_NEAR(double(count), double(expected.size()), 2 + 0.003 * double(expected.size()));
  EXPECT_LE(missing, 2 + expected.size() / 300);
  EXPECT_LE(kinds, 2 + expected.size() / 300);
  EXPECT_LE(far, few);
  EXPECT_LE(unordered, 2u);
}

TEST_F(WhitewaterTest, EmissionMatchesReferenceOfRandomInput) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 0.5);
  std::uniform_real_distribution<double> in(-0.3, 1.0);
  for (const bool walls : {false, true}) {
    SCOPED_TRACE(walls);
    WhiteFluid fluid = block(
        0.05, {0.5, 0.4, 0.45}, [&](const dvec3& x) { return dvec3(2 + noise(random), 3 * x.x + noise(random), noise(random)); }, 0.2);
    for (int k = 0; k < 60; ++k) {
      fluid.positions.push_back(walls ? glm::abs(dvec3(in(random), in(random), in(random))) : dvec3(in(random), in(random), in(random)));
      fluid.velocities.push_back({2, noise(random), 2});
    }
    WhitewaterDesc desc{.capacity = uint32_t(fluid.positions.size()) + 40, .room = 20'000, .parcel_m3 = 4e-7, .breaking = 0.5};
    if (walls) desc.domain = Domain{.min = {0, 0, 0}, .max = {1, 1, 1}, .open = SideMask(1u << sideBit(Axis::PlusY))};
    Whitewater white = create(desc);
    const double seconds = 0.01;
    const WhitewaterSnapshot first = step(white, fluid, seconds);
    const auto births = reference::whiteBirths(fluid, desc, seconds, 0);
    ASSERT_GT(births.size(), 500u);
    expectLikeReference(first, 0, first.place.size(), births, 2e-5);

    // A second step: those that live on, then new ones
    std::vector<WhiteParticle> old;
    for (size_t k = 0; k < first.place.size(); ++k) {
      const Float3 v = velocityOf(first.motion[k]);
      old.push_back({{first.place[k].x, first.place[k].y, first.place[k].z}, {v.x, v.y, v.z}, first.place[k].w, first.motion[k][3]});
    }
    const WhitewaterSnapshot second = step(white, fluid, seconds);
    const WhitewaterStats stats = whitewaterStats(second.counts);
    const size_t kept = first.place.size() - size_t(stats.dissolved);
    expectLikeReference(second, 0, kept, reference::whiteAdvance(old, fluid, desc, seconds), 2e-5);
    expectLikeReference(second, kept, second.place.size() - kept, reference::whiteBirths(fluid, desc, seconds, 1), 2e-5);
    EXPECT_EQ(stats.spray + stats.foam + stats.bubbles, second.place.size());
    EXPECT_EQ(stats.emitted, second.place.size() + stats.dissolved);
    EXPECT_EQ(stats.overflow, 0u);
    EXPECT_EQ(stats.boundHits, 0u);
  }
}

TEST_F(WhitewaterTest, MotionMatchesReferenceOfRandomInput) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> in(-0.2, 0.8), speed(-2, 2), age(0, 3);
  const WhiteFluid fluid = block(
      0.05, {0.6, 0.4, 0.5}, [&](const dvec3& x) { return dvec3(x.y, -x.x, 0.5 * x.z); }, 0.2);
  std::vector<WhiteParticle> particles;
  for (uint32_t k = 0; k < 3000; ++k)
    particles.push_back({{in(random), in(random), in(random)}, {speed(random), speed(random), speed(random)}, age(random), k << 2 | k % 3});
  const WhitewaterSnapshot start = snapshotOf(particles);
  const WhitewaterDesc desc{.capacity = uint32_t(fluid.positions.size()),
                            .room = 4000,
                            .parcel_m3 = 1,
                            .domain = Domain{.min = {0, 0, -0.1}, .max = {0.6, 2, 0.5}},
                            .snapshot = &start};
  Whitewater white = create(desc);
  const WhitewaterSnapshot made = step(white, fluid, 0.02);
  const WhitewaterStats stats = whitewaterStats(made.counts);
  EXPECT_EQ(stats.emitted, 0u);
  const auto expected = reference::whiteAdvance(particles, fluid, desc, 0.02);
  for (uint32_t kind = 0; kind < kWhiteClasses; ++kind)
    EXPECT_GT(std::ranges::count_if(expected, [&](const WhiteParticle& p) { return (p.tag & 3) == kind; }), 50) << kind;
  EXPECT_GT(stats.dissolved, 100u);
  expectLikeReference(made, 0, made.place.size(), expected, 2e-5);
}

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

TEST_F(WhitewaterTest, SprayFliesFoamFollowsBubblesRise) {
  const WhiteFluid fluid = block(0.05, {1, 0.5, 1}, [](const dvec3&) { return dvec3(0.3, 0, 0); });
  const std::vector<WhiteParticle> particles = {{{0.5, 2.0, 0.5}, {1, 2, 0}, 0, 0u << 2 | kWhiteSpray},
                                                {{0.3, 0.5, 0.5}, {0, 0, 0}, 0, 1u << 2 | kWhiteFoam},
                                                {{0.5, 0.2, 0.5}, {0, 0, 0}, 0, 2u << 2 | kWhiteBubble}};
  for (const int steps : {6, 15, 60}) {  // of a quarter second
    const WhitewaterSnapshot start = snapshotOf(particles);
    Whitewater white = create({.capacity = uint32_t(fluid.positions.size()), .room = 10, .parcel_m3 = 1, .snapshot = &start});
    const WhitewaterSnapshot made = step(white, fluid, 0.25 / steps, steps);
    ASSERT_EQ(made.place.size(), 3u);
    EXPECT_NEAR(made.place[0].x, 0.75, 1e-5);
    EXPECT_NEAR(made.place[0].y, 2 + 0.5 - 0.5 * 9.81 * 0.0625, 1e-5);
    EXPECT_EQ(made.motion[1][3] & 3, kWhiteFoam);
    EXPECT_NEAR(made.place[1].x, 0.3 + 0.075, 0.007);
    EXPECT_NEAR(made.place[1].y, 0.5, 1e-5);
    EXPECT_EQ(made.motion[2][3] & 3, kWhiteBubble);
    EXPECT_NEAR(made.place[2].y, 0.2 + 0.25 * 0.25, 0.006);  // it takes a hundredth of a second to reach its speed
    EXPECT_NEAR(velocityOf(made.motion[2]).y, 0.25, 1e-4);
  }
}

/// Particles a second, over steps of 1 / `rate` s.
double emittedPerSecond(const WhitewaterStats& stats, double seconds) { return double(stats.emitted + stats.overflow) / seconds; }

TEST_F(WhitewaterTest, EmissionIsIndependentOfFrameRateAndSpacing) {
  const auto vortices = [](const dvec3& x) {
    return 1.5 * dvec3(1.5 + std::sin(12 * x.x) * std::cos(12 * x.y), 0.5 - std::cos(12 * x.x) * std::sin(12 * x.y), std::sin(9 * x.z) / 3);
  };
  const auto impact = [](const dvec3& x) { return dvec3(x.x < 0.24 ? 2.5 : -1.0, 0, 0); };  // a jump of 3.5 m/s
  const auto outward = [](const dvec3& x) { return 3.0 * glm::normalize(x); };
  struct Case {
    const char* name;
    std::function<WhiteFluid(double)> fluid;
    double trapping, breaking, parcel;
  };
  const Case cases[] = {{"vortices",
                         [&](double d) {
                           return block(d, {0.48, 0.24, 0.24}, vortices);
                         },
                         0.02, 0, 1e-7},
                        {"impact",
                         [&](double d) {
                           return block(d, {0.48, 0.24, 0.24}, impact);
                         },
                         0.02, 0, 1e-7},
                        {"crest", [&](double d) { return ball(d, 0.2, outward); }, 0, 0.05, 1e-6}};
  constexpr double kSeconds = 0.5;
  for (const Case& one : cases) {
    std::vector<double> rates;
    for (const auto& [spacing, fps] : {std::pair{0.03, 24}, {0.02, 24}, {0.015, 24}, {0.02, 60}, {0.02, 120}}) {
      const WhiteFluid fluid = one.fluid(spacing);
      Whitewater white = create({.capacity = uint32_t(fluid.positions.size()),
                                 .room = 20'000,
                                 .parcel_m3 = one.parcel,
                                 .trapping = one.trapping,
                                 .breaking = one.breaking});
      const WhitewaterSnapshot made = step(white, fluid, 1.0 / fps, static_cast<int>(std::lround(kSeconds * fps)));
      rates.push_back(emittedPerSecond(whitewaterStats(made.counts), kSeconds));
    }
    const double middle = rates[1];
    EXPECT_GT(middle, 4000) << one.name;  // so that chance is 2 %
    for (const double rate : rates) EXPECT_NEAR(rate, middle, 0.1 * middle) << one.name;
    std::printf("%s: %.0f %.0f %.0f a second at 24 frames a second; %.0f at 60, %.0f at 120\n", one.name, rates[0], rates[1], rates[2],
                rates[3], rates[4]);
  }
}

TEST_F(WhitewaterTest, LifeIsIndependentOfFrameRateAndSpacing) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> in(0.05, 0.45);
  std::vector<WhiteParticle> particles;
  for (uint32_t k = 0; k < 2000; ++k) particles.push_back({{in(random), 0.24, in(random)}, {0, 0, 0}, 0, k << 2 | kWhiteFoam});
  const WhitewaterSnapshot start = snapshotOf(particles);
  for (const auto& [spacing, fps] : {std::pair{0.04, 24}, {0.03, 24}, {0.02, 24}, {0.03, 60}, {0.03, 120}}) {
    const WhiteFluid still = block(spacing, {0.48, 0.24, 0.48}, [](const dvec3&) { return dvec3(0); });
    Whitewater white =
        create({.capacity = uint32_t(still.positions.size()), .room = 2000, .parcel_m3 = 1, .life_s = 1, .snapshot = &start});
    const WhitewaterSnapshot made = step(white, still, 1.0 / fps, fps);
    EXPECT_NEAR(double(made.place.size()), 1000, 100) << spacing << " " << fps;  // half of them live longer than the mean
    EXPECT_EQ(whitewaterStats(made.counts).emitted, 0u);
  }
}

TEST_F(WhitewaterTest, FluidThatIsSlowOrMovesAsOneTrapsNothing) {
  const auto emitted = [&](const std::function<dvec3(const dvec3&)>& velocity) {
    const WhiteFluid fluid = block(0.05, {0.5, 0.5, 0.5}, velocity, 0.1);
    Whitewater white = create({.capacity = uint32_t(fluid.positions.size()), .parcel_m3 = 1e-8, .breaking = 0});
    return whitewaterStats(step(white, fluid, 0.02).counts).emitted;
  };
  EXPECT_EQ(emitted([](const dvec3& x) { return dvec3(3 * x.y - 1, 0, 0); }), 0u);  // below 1 m/s
  EXPECT_EQ(emitted([](const dvec3&) { return dvec3(0.9, 0.3, 0); }), 0u);
  EXPECT_EQ(emitted([](const dvec3&) { return dvec3(3, 0.2, 0.2); }), 0u);  // fast, without strain
  EXPECT_GT(emitted([](const dvec3& x) { return dvec3(20 * x.y, 0, 0); }), 0u);
}

TEST_F(WhitewaterTest, SameBitsOnEachRunAndFromSnapshot) {
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 1);
  const WhiteFluid fluid = block(
      0.05, {0.5, 0.4, 0.5}, [&](const dvec3&) { return dvec3(2 + noise(random), noise(random), noise(random)); }, 0.3);
  WhitewaterDesc desc{.capacity = uint32_t(fluid.positions.size()), .room = 5000, .parcel_m3 = 1e-5};
  Whitewater one = create(desc), other = create(desc);
  const WhitewaterSnapshot half = step(one, fluid, 0.02, 3), whole = step(one, fluid, 0.02, 3);
  ASSERT_GT(half.place.size(), 100u);
  EXPECT_TRUE(step(other, fluid, 0.02, 6) == whole);
  desc.snapshot = &half;
  Whitewater resumed = create(desc);
  EXPECT_TRUE(step(resumed, fluid, 0.02, 3) == whole);
  Whitewater paused = create(desc);
  EXPECT_TRUE(step(paused, fluid, 0) == half);
  desc.snapshot = nullptr;
  desc.seed = 2;
  Whitewater differs = create(desc);
  EXPECT_FALSE(step(differs, fluid, 0.02, 6) == whole);
}

TEST_F(WhitewaterTest, BoundsCountAndCountsOverflow) {
  const WhiteFluid fluid = block(0.05, {0.4, 0.4, 0.4}, [](const dvec3& x) { return dvec3(2, 20 * x.x, 0); });
  const WhitewaterDesc wide{.capacity = uint32_t(fluid.positions.size()), .room = 20'000, .parcel_m3 = 2e-7};
  Whitewater roomy = create(wide);
  const WhitewaterStats free = whitewaterStats(step(roomy, fluid, 0.01).counts);
  ASSERT_GT(free.emitted, 1000u);
  for (const uint32_t room : {1u, 64u, 777u}) {
    WhitewaterDesc narrow = wide;
    narrow.room = room;
    Whitewater white = create(narrow);
    const WhitewaterSnapshot made = step(white, fluid, 0.01);
    const WhitewaterStats stats = whitewaterStats(made.counts);
    EXPECT_EQ(made.place.size(), room);
    EXPECT_EQ(stats.spray + stats.foam + stats.bubbles, room);
    EXPECT_EQ(stats.emitted, room);
    EXPECT_EQ(stats.overflow, free.emitted - room);
  }
  WhitewaterDesc many = wide;  // more than kWhiteMaxBirths from each particle
  many.parcel_m3 = 1e-13;
  many.room = 200'000;
  Whitewater white = create(many);
  const WhitewaterStats stats = whitewaterStats(step(white, fluid, 0.01).counts);
  EXPECT_EQ(stats.emitted, many.room);
  EXPECT_GT(stats.overflow, uint64_t{kWhiteMaxBirths} * fluid.positions.size());
}

TEST_F(WhitewaterTest, DegenerateInput) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  const auto finite = [&](const std::vector<dvec3>& positions, const dvec3& velocity) {
    const WhiteFluid fluid{positions, std::vector<dvec3>(positions.size(), velocity), 0.05};
    Whitewater white =
        create({.capacity = uint32_t(std::max<size_t>(positions.size(), 1)), .room = 1000, .parcel_m3 = 1e-7, .breaking = 1});
    const WhitewaterSnapshot made = step(white, fluid, 0.02, 3);
    for (size_t k = 0; k < made.place.size(); ++k) {
      const Float3 v = velocityOf(made.motion[k]);
      for (const float number : {made.place[k].x, made.place[k].y, made.place[k].z, v.x, v.y, v.z}) EXPECT_TRUE(std::isfinite(number));
      EXPECT_LT(made.motion[k][3] & 3, kWhiteClasses);
    }
    return whitewaterStats(made.counts);
  };
  EXPECT_EQ(finite({}, {}).emitted, 0u);
  finite({{0, 0, 0}}, {3, 0, 0});
  finite({{0, 0, 0}, {0.05, 0, 0}, {0.1, 0, 0}}, {0, 5, 0});
  finite({{-1e5, 0, 0}, {1e5, 4, 4}}, {0, 5, 0});
  finite({{nan, 0, 0}, {0, infinite, 0}, {1e11, 1e11, 1e11}, {1e9, 0, 0}, {0, 0, 0}}, {3, 3, 3});
  finite({{0, 0, 0}, {0.05, 0, 0}}, {nan, infinite, 0});
  finite({{0, 0, 0}, {0.05, 0, 0}}, {1e9, 0, 0});
  EXPECT_EQ(finite(std::vector<dvec3>(300, {4, 0, -4}), {3, 3, 3}).boundHits, 0u);
  EXPECT_GT(finite(std::vector<dvec3>(6000, {1, 2, 3}), {3, 3, 3}).boundHits, 0u);
}

TEST_F(WhitewaterTest, RejectsValuesOutOfRange) {
  const auto message = [&](const WhitewaterDesc& desc) {
    const auto made = Whitewater::create(device(), desc);
    return made ? std::string() : made.error().message;
  };
  const WhitewaterDesc good{.capacity = 10, .parcel_m3 = 1};
  EXPECT_EQ(message(good), "");
  EXPECT_EQ(message({.parcel_m3 = 1}), "whitewater: capacity is 0; expected 1 to 4,194,304 particles");
  EXPECT_EQ(message({.capacity = 10, .room = 0, .parcel_m3 = 1}), "whitewater: room is 0; expected 1 to 4,194,304 particles");
  EXPECT_EQ(message({.capacity = 10}), "whitewater: parcel_m3 is 0; expected 1e-30 to 1e30 (m^3)");
  EXPECT_EQ(message({.capacity = 10, .parcel_m3 = 1, .trapping = -1}), "whitewater: trapping is -1; expected 0 to 1e6");
  EXPECT_EQ(message({.capacity = 10, .parcel_m3 = 1, .life_s = 0}), "whitewater: life_s is 0; expected 1e-6 to 1e9 (s)");
  EXPECT_EQ(message({.capacity = 10, .parcel_m3 = 1e-46}), "whitewater: parcel_m3 is 1e-46; expected 1e-30 to 1e30 (m^3)")
      << "0 as a float";
  EXPECT_EQ(message({.capacity = 10, .parcel_m3 = 1, .gravity = {0, 1e39, 0}}),
            "whitewater: gravity is 1e+39; expected numbers of at most 1e30");
  const WhitewaterSnapshot torn{.place = std::vector<Float4>(3)};
  EXPECT_EQ(message({.capacity = 10, .parcel_m3 = 1, .snapshot = &torn}), "whitewater: the snapshot of 3 particles does not fit");
}

TEST_F(WhitewaterTest, CompileReportsInvalidSteps) {
  const Buffer four = upload("position", std::vector<Float4>(4)), two = upload("velocity", std::vector<Float4>(2));
  const auto message = [&](uint32_t capacity, bool moves, double seconds, std::optional<Double3> gravity = {}, uint32_t solids = 0) {
    Whitewater white = create({.capacity = 3, .parcel_m3 = 1, .solids = solids});
    Graph graph;
    FluidState state;
    state.capacity = capacity;
    state.spacing = 1;
    state.position = graph.import("position", importOf(four));
    if (moves) state.velocity = graph.import("velocity", importOf(four));
    (void)white.addTo(graph, state, seconds, gravity);
    const auto compiled = graph.compile();
    return compiled ? std::string() : compiled.error().message;
  };
  EXPECT_NE(message(4, true, 0.1).find("FluidState::capacity is 4; expected at most 3"), std::string::npos);
  EXPECT_NE(message(3, false, 0.1).find("FluidState::velocity is null"), std::string::npos);
  EXPECT_NE(message(3, true, 0.1, {}, 2).find("FluidState::boundaries is null or too small; expected the records of 2 solids"),
            std::string::npos);
  Whitewater white = create({.capacity = 3, .parcel_m3 = 1});
  Graph graph;
  FluidState narrow;
  narrow.capacity = 3;
  narrow.spacing = 1;
  narrow.position = graph.import("position", importOf(four));
  narrow.velocity = graph.import("velocity", importOf(two));
  (void)white.addTo(graph, narrow, 0.1);
  const auto compiled = graph.compile();
  ASSERT_FALSE(compiled);
  EXPECT_NE(compiled.error().message.find("FluidState::velocity has 32 bytes"), std::string::npos) << compiled.error().message;
  EXPECT_NE(message(3, true, -1).find("the step is -1; expected 0 to 1e6 (s)"), std::string::npos);
  EXPECT_NE(message(3, true, std::numeric_limits<double>::quiet_NaN()).find("the step is"), std::string::npos);
  EXPECT_NE(message(3, true, 0.1, Double3{0, std::numeric_limits<double>::infinity(), 0}).find("gravity is"), std::string::npos);
}

}  // namespace
}  // namespace rill::test
