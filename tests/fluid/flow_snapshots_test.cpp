// Snapshots of scenes with emitters and drains, and advances in pieces.
#include <optional>

#include "fluid/flows_fixture.hpp"
#include "fluid/snapshot.hpp"

namespace rill::test {
namespace flows_test {

/// A tank with all of it.
Trial busyTank() {
  Trial t = tank();
  t.scene.fluid.viscosity = 0.05;
  t.scene.domain->open = 1u << 1;
  t.scene.domain->open_removes = true;
  t.scene.solids = {ball({0.5, 0.3, 0.2}, 0.12)};
  t.scene.emitters = {disc({0.3, 0.8, 0.25}, 0.1, {0.3, -1, 0}, 1.3), disc({0.2, 0.2, 0.25}, 0.1, {1, 0, 0}, 0.4)};
  t.scene.emitters[0].motion = {{.at = 0.01}, {.at = 0.2, .translate = {0.3, 0, 0}, .rotate = turn({0, 0, 1}, 0.6)}};
  t.scene.drains = {{.shape = BoxShape{{0.6, 0, 0}, {0.8, 0.1, 0.5}}}};
  std::vector<glm::dvec3> all;
  std::swap(all, t.x);
  addOutsideSolids(t, all);
  return t;
}

TEST_F(FlowsTest, GoesOnFromASnapshotBitForBit) {
  const FluidLedger ledger = goesOnFromASnapshot(busyTank());
  EXPECT_GT(ledger.emitted, 20u);
  EXPECT_GT(ledger.drained, 10u);
}

// A tank with emitters and a drain, and one without anything that comes or goes.
TEST_F(FlowsTest, SnapshotGoesOnWithEmittersThatAreAdded) {
  for (const bool busy : {true, false}) {
    SCOPED_TRACE(busy);
    Trial t = busy ? busyTank() : tank();
    auto before = start(t);
    for (int frame = 0; frame < 3; ++frame) before->advance(1.0 / 60);
    const FluidLedger ledger = before->stats().ledger;
    FluidSnapshot state = before->saved();
    const size_t present = particles(state).size();
    const Scene old = t.scene;
    t.scene.emitters.push_back(disc({0.8, 0.85, 0.25}, 0.1, {0, -1, 0}, 1));
    addEmitters(state, old, t.scene, t.origin);
    auto after = start(t, &state);
    const auto added = static_cast<uint32_t>(old.emitters.size());
    for (int frame = 0; frame < 3; ++frame) after->advance(1.0 / 60);
    EXPECT_EQ(after->fluid().emitted()[added].particles, 0u) << "closed at first";
    if (!busy) { EXPECT_EQ(particles(after->saved()).size(), present); }
    const MouthLattice lattice = mouthLattice(t.scene.emitters[added].mouth, t.d());
    const double flow = 0.02;
    after->emitters = {{.emitter = added, .flow = flow}};
    for (int frame = 0; frame < 12; ++frame) after->advance(1.0 / 60);
    EXPECT_NEAR(after->fluid().emitted()[added].volume, flow * 12 / 60, lattice.area * lattice.thickness);
    const FluidLedger now = after->stats().ledger;
    EXPECT_EQ(now.filled, ledger.filled);
    EXPECT_EQ(now.filled + now.emitted, particles(after->saved()).size() + now.drained + now.left + now.inactive);
    if (!busy) continue;
    EXPECT_GT(now.drained, ledger.drained) << "the drain goes on";
    EXPECT_GE(after->fluid().emitted()[0].particles, before->fluid().emitted()[0].particles);
  }
}

TEST_F(FlowsTest, PiecesOfAnAdvanceDoNotMatter) {
  const Trial t = busyTank();
  std::optional<FluidSnapshot> first;
  for (const uint32_t piece : {64u, 3u, 17u}) {
    auto run = start(t);
    for (int frame = 0; frame < 4; ++frame) run->advance(1.0 / 60, piece);
    FluidSnapshot state = run->saved();
    if (!first)
      first = std::move(state);
    else
      EXPECT_EQ(firstDifference(state, *first), "") << piece;
  }
}

}  // namespace flows_test
}  // namespace rill::test
