// capacityOf() and scenes whose fills exceed fluid.capacity.
#include <cmath>
#include <limits>

#include "support.hpp"

namespace rill::test {
namespace {

/// Spacing 1/8 m, so that volumes over spacing^3 are exact; duration 3 s.
Scene emitting(std::vector<Emitter> emitters) {
  Scene s;
  s.fluid.spacing = 0.125;
  s.duration = 3;
  s.emitters = std::move(emitters);
  return s;
}

const RectMouth kMouth{.size = {0.5, 0.25}};  // 8 particles

TEST(Capacity, IsTheGivenOne) {
  Scene s = emitting({{.mouth = kMouth, .flow = 1}});
  s.fluid.capacity = 1000;
  EXPECT_EQ(capacityOf(s, 10), 1000U);
}

TEST(Capacity, IsTheFilledWithoutEmitters) {
  EXPECT_EQ(capacityOf(emitting({}), 1234), 1234U);
  EXPECT_EQ(capacityOf(emitting({}), 0), 0U);
}

TEST(Capacity, AddsFlowTimesTimeAndALayer) {
  EXPECT_EQ(capacityOf(emitting({{.mouth = kMouth, .flow = 0.25}}), 100), 100U + 0.25 * 3 * 512 + 8);
  EXPECT_EQ(capacityOf(emitting({{.mouth = kMouth, .speed = 2}}), 100), 100U + 2 * 0.125 * 3 * 512 + 8) << "speed x area";
  const double area = M_PI * 0.25 * 0.25;
  EXPECT_EQ(capacityOf(emitting({{.mouth = DiscMouth{.radius = 0.25}, .speed = 1}}), 0), std::ceil(area * 3 * 512) + std::ceil(area * 64));
  EXPECT_EQ(capacityOf(emitting({{.mouth = kMouth, .flow = 1.0 / 1024}}), 0), 2U + 8) << "1.5 particles";
}

TEST(Capacity, CountsTheTimeWithinTheDuration) {
  const auto added = [](double from, std::optional<double> until) {
    return capacityOf(emitting({{.mouth = kMouth, .flow = 0.25, .from = from, .until = until}}), 0) - 8;
  };
  EXPECT_EQ(added(1, {}), 256U);
  EXPECT_EQ(added(1, 2), 128U);
  EXPECT_EQ(added(0, 100), 384U);
  EXPECT_EQ(added(3, {}), 0U);
  EXPECT_EQ(added(4, 5), 0U);
}

TEST(Capacity, AddsAllEmitters) {
  const Emitter one{.mouth = kMouth, .flow = 0.25};
  EXPECT_EQ(capacityOf(emitting({one, one, one}), 5), 5U + 3 * (384 + 8));
}

TEST(Capacity, IsClampedWhateverTheNumbers) {
  constexpr double kMax = std::numeric_limits<float>::max();
  EXPECT_EQ(capacityOf(emitting({{.mouth = kMouth, .flow = 1e6}}), 0), kMaxParticles);
  Scene s = emitting({{.mouth = DiscMouth{.radius = kMax}, .speed = kMax}, {.mouth = kMouth, .flow = kMax}});
  EXPECT_EQ(capacityOf(s, 3), kMaxParticles);
  s.fluid.spacing = 1e-30;
  EXPECT_EQ(capacityOf(s, std::numeric_limits<uint64_t>::max()), kMaxParticles);
}

TEST(Capacity, BelowWhatTheFillsMakeIsRefused) {
  Scene s = scene(R"({"rill": "0.2", "fluid": {"spacing": 0.1, "capacity": 1000}, "fill": [{"box": {}}]})");
  EXPECT_EQ(particles(s).positions.size(), 1000U);
  s.fluid.capacity = 999;
  const auto refused = makeParticles(s);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(refused.error().message, "dam: fluid.capacity: found 999, but the fills make 1,000 particles; expected at least as many");
  s.solids = {{.shape = SphereShape{{0.5, 0.5, 0.5}, 0.3}}};
  EXPECT_EQ(particles(s).positions.size(), 864U) << "those left out need no room";
  s.fluid.spacing = 0;
  s.fluid.particles = 8000;
  const auto byCount = makeParticles(s);
  ASSERT_FALSE(byCount);
  EXPECT_EQ(byCount.error().message.rfind("dam: fluid.capacity: found 999, but the fills make ", 0), 0U) << byCount.error().message;
}

}  // namespace
}  // namespace rill::test
