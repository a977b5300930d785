// Diffuse particles: full buffers, degenerate fluid, values out of range.
#include <limits>
#include <optional>

#include "whitewater/whitewater_fixture.hpp"

namespace rill::test {
namespace whitewater_test {

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

}  // namespace whitewater_test
}  // namespace rill::test
