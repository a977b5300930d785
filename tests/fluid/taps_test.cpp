// Emitters that the host opens, moves and closes; slow ones.
#include <tuple>

#include "fluid/flows_fixture.hpp"

namespace rill::test {
namespace flows_test {

TEST_F(FlowsTest, FollowsTheHostsTap) {
  Trial t = space();
  t.scene.emitters = {disc({0, 0, 0}, 0.15, {1, 0, 0}, 1), disc({0, 3, 0}, 0.15, {1, 0, 0}, 1)};
  const MouthLattice lattice = mouthLattice(t.scene.emitters[0].mouth, t.d());
  auto run = start(t);
  double volume = 0;
  std::map<uint32_t, std::pair<glm::dvec3, glm::dvec3>> before;
  for (const auto& [flow, center, normal] : {std::tuple{0.0, Double3{0, 0, 0}, Double3{1, 0, 0}},
                                             {0.05, {0, 0, 0}, {0, 0, 3}},
                                             {0.12, {-2, 0, 0}, {-1, 0, 0}},
                                             {0.0, {-2, 0, 0}, {-1, 0, 0}},
                                             {0.08, {0, 0, -4}, {0.1, -0.2, -1}}}) {
    run->emitters = {{.emitter = 0, .flow = flow, .center = center, .normal = normal}};
    run->advance(0.05);
    run->advance(0.05);
    volume += 0.1 * flow;
    EXPECT_NEAR(run->fluid().emitted()[0].volume, volume, lattice.area * lattice.thickness);
    auto now = particles(run->saved());
    const double speed = flow / lattice.area;
    size_t born = 0;
    for (const auto& [id, particle] : now) {
      if (before.contains(id) || std::abs(particle.first.y - 3) < 0.3) continue;
      const glm::dvec3 from = particle.first - vec(center), along = glm::normalize(vec(normal));
      EXPECT_LT(glm::length(from - glm::dot(from, along) * along), 0.2) << id;
      EXPECT_LT(glm::dot(from, along), speed * 0.1 + t.d()) << id;
      EXPECT_NEAR(glm::dot(particle.second, along), speed, 0.1 * speed) << id;
      ++born;
    }
    EXPECT_EQ(born > 0, flow > 0);
    before = std::move(now);
  }
}

TEST_F(FlowsTest, PulsesOfATapAddUp) {
  Trial t = space();
  t.scene.emitters = {disc({0, 0, 0}, 0.15, {1, 0, 0}, 1)};
  auto run = start(t);
  for (int pulse = 0; pulse < 40; ++pulse) {
    run->emitters = {{.flow = pulse % 2 == 0 ? 0.06 : 0.0}};
    run->advance(0.013);
  }
  const MouthLattice lattice = mouthLattice(t.scene.emitters[0].mouth, t.d());
  EXPECT_NEAR(run->fluid().emitted()[0].volume, 20 * 0.013 * 0.06, lattice.area * lattice.thickness);
}

TEST_F(FlowsTest, TurningATapDownLeavesItsJetInPlace) {
  Trial t = space();
  t.scene.gravity = {0, -9.81, 0};
  t.scene.emitters = {disc({0, 0, 0}, 0.15, {1, 0, 0}, 1)};
  auto run = start(t);
  run->advance(0.1);
  for (int k = 0; k < 6; ++k) {
    run->emitters = {{.flow = k % 2 == 0 ? 1e-6 : 0.07}};
    run->advance(0.04);
  }
  for (const auto& [id, particle] : particles(run->saved())) {
    EXPECT_LT(particle.first.x, 0.4) << id;
    EXPECT_GT(particle.first.y, -0.7) << id;
  }
}

// A layer waits for the list no longer than in which it falls by a quarter of a spacing.
TEST_F(FlowsTest, SlowTapsDripFromTheirMouths) {
  Trial t = space();
  t.scene.gravity = {0, -9.81, 0};
  t.scene.emitters = {disc({0, 0, 0}, 0.1, {0, -1, 0}, 0.03)};
  t.step = 5e-3;
  auto run = start(t);
  for (int frame = 0; frame < 240; ++frame) run->advance(1.0 / 60);
  const auto born = reference::births(settingsOf(t.scene.emitters[0], t.d()), run->progress().time_s, vec(t.scene.gravity));
  const auto found = particles(run->saved());
  ASSERT_GT(found.size(), 4u);
  for (const auto& [id, particle] : found) EXPECT_LT(glm::length(particle.first - born[id].position), 0.1) << id;
}

TEST_F(FlowsTest, RejectsInvalidEmitterTargets) {
  Trial t = space();
  t.scene.emitters = {disc({0, 0, 0}, 0.15, {1, 0, 0}, 1)};
  auto run = start(t);
  const double nan = std::nan("");
  for (const auto& [target, message] : {std::pair{EmitterTarget{.emitter = 1}, "emitters[0].emitter is 1; the scene has 1 emitter"},
                                        {EmitterTarget{.flow = -1}, "emitters[0].flow is -1; expected"},
                                        {EmitterTarget{.flow = nan}, "emitters[0].flow is"},
                                        {EmitterTarget{.flow = 1, .center = Double3{0, nan, 0}}, "emitters[0].center is"},
                                        {EmitterTarget{.flow = 1, .normal = Double3{0, 0, 0}}, "emitters[0].normal is"}}) {
    Graph graph;
    run->fluid().addTo(graph, {.advance_s = 0.01, .emitters = std::span(&target, 1)});
    const auto compiled = graph.compile();
    ASSERT_FALSE(compiled);
    EXPECT_NE(compiled.error().message.find(message), std::string::npos) << compiled.error().message;
  }
}

}  // namespace flows_test
}  // namespace rill::test
