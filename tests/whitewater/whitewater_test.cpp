// Diffuse particles on the device against the reference in double precision, and what must hold of any.
#include <algorithm>
#include <cstdio>

#include "whitewater/whitewater_fixture.hpp"

namespace rill::test {
namespace whitewater_test {

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

}  // namespace whitewater_test
}  // namespace rill::test
