// Drains, open sides that remove, outflow, and the ledger of particles.
#include <random>

#include "fluid/flows_fixture.hpp"

namespace rill::test {
namespace flows_test {

TEST_F(FlowsTest, DrainsAndOpenSidesRemoveWithinAFrame) {
  Trial t = tank();
  t.scene.domain->open = 1u << 1 | 1u << 3;  // +x, +y
  t.scene.domain->open_removes = true;
  t.scene.drains = {{.name = "plug", .shape = BoxShape{{0, 0, 0}, {0.2, 0.1, 0.2}}, .from = 0.045},
                    {.shape = SphereShape{{0.5, 0.2, 0.25}, 0.1}, .until = 0.105},
                    {.shape = SphereShape{{0.5, 0.2, 0.25}, 0.05}}};
  t.scene.emitters = {disc({0.3, 0.9, 0.25}, 0.08, {0, -1, 0}, 1)};
  for (const Gather gather : kGathers) {
    t.gather = gather;
    auto run = start(t);
    for (int frame = 0; frame < 12; ++frame) {
      run->advance(1.0 / 60);
      expectBalance(*run);
      const double time = run->progress().time_s;
      for (const auto& [id, particle] : particles(run->saved())) {
        const glm::dvec3& x = particle.first;
        EXPECT_LE(x.x, 1) << id;
        if (time > 0.05) { EXPECT_FALSE(x.x < 0.2 && x.y < 0.1 && x.z < 0.2) << id; }
        if (time < 0.1) { EXPECT_GT(glm::length(x - glm::dvec3(0.5, 0.2, 0.25)), 0.1) << id; }
      }
    }
    const FluidLedger l = expectBalance(*run);
    const auto drained = run->fluid().drained();
    EXPECT_GT(l.left, 50u);
    EXPECT_GT(drained[0].particles, 10u);
    EXPECT_GT(drained[1].particles, 10u);
    EXPECT_GT(drained[2].particles, 0u) << "once the larger ball is closed";
    EXPECT_EQ(l.drained, drained[0].particles + drained[1].particles + drained[2].particles);
    EXPECT_LT(run->fluid().count(), t.x.size() + l.emitted - l.drained / 2) << "removed particles take no room";
  }
}

TEST_F(FlowsTest, LedgerClosesInRandomScenes) {
  uint64_t emitted = 0, drained = 0, left = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const auto place = [&] { return Double3{uniform(0, 1), uniform(0, 1), uniform(0, 0.5)}; };
    const auto direction = [&] { return Double3{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; };
    Trial t = tank();
    t.gather = kGathers[seed % 3];
    t.scene.domain->open = static_cast<SideMask>(random() % 64);
    t.scene.domain->open_removes = t.scene.domain->open != 0;
    t.capacity = seed % 2 == 0 ? 1200 : 4000;
    for (uint64_t k = random() % 4; k > 0; --k) t.scene.emitters.push_back(disc(place(), uniform(0.02, 0.2), direction(), uniform(0.1, 4)));
    for (uint64_t k = random() % 4; k > 0; --k) t.scene.drains.push_back({.shape = SphereShape{place(), uniform(0.05, 0.3)}});
    auto run = start(t);
    for (int frame = 0; frame < 8; ++frame) {
      run->advance(1.0 / 60);
      expectBalance(*run);
      EXPECT_EQ(particles(run->saved()).size(), run->stats().particles);
    }
    const FluidLedger l = run->stats().ledger;
    emitted += l.emitted, drained += l.drained, left += l.left;
  }
  EXPECT_GT(emitted, 100u);
  EXPECT_GT(drained, 100u);
  EXPECT_GT(left, 100u);
}

TEST_F(FlowsTest, OutflowIsAWallUpToItsLevel) {
  Trial t = trial();
  setWalls(t, {0.75, 1, 0.5});
  t.x = block({11, 9, 7}, t.d(), {0.03, 0.03, 0.03}, 0.2);
  t.v = randomCloud(t.x.size(), 2, 5, glm::dvec3(-1));
  for (const Axis side : {Axis::PlusX, Axis::MinusX, Axis::PlusZ, Axis::MinusZ}) {
    SCOPED_TRACE(sideBit(side));
    t.scene.domain->outflow = Outflow{side, 0.3};
    t.scene.fluid.viscosity = 0.02;
    expectEqual(t, 6, 2e-3, 2e-3);  // before particles leave, which the reference does not take out
  }
}

TEST_F(FlowsTest, ChannelKeepsItsFlow) {
  Trial t = trial();
  setWalls(t, {2, 0.8, 0.3});
  t.x = block({32, 5, 5}, t.d());
  t.scene.domain->inflow = Inflow{.side = Axis::MinusX, .level = 0.31, .speed = 0.6};
  t.scene.domain->outflow = Outflow{.side = Axis::PlusX, .level = 0.2};
  t.scene.solver.tolerance = 1e-3;
  t.settle = true;
  t.capacity = 3000;
  t.step = 5e-3;
  auto run = start(t);
  double left = 0, before = 0;
  for (int frame = 0; frame < 360; ++frame) {
    run->advance(1.0 / 60);
    if (frame == 239) before = double(expectBalance(*run).left);
  }
  const FluidStats s = run->stats();
  left = (double(s.ledger.left) - before) * std::pow(t.d(), 3) / 2;
  EXPECT_NEAR(left, 0.6 * 0.31 * 0.3, 0.1 * 0.6 * 0.31 * 0.3) << "as much leaves as comes";
  EXPECT_LT(s.densityErrorMean, 3e-3);
  EXPECT_EQ(s.outside, 0u);
}

}  // namespace flows_test
}  // namespace rill::test
