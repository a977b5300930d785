// A fluid that is created from a snapshot continues with the bits of the original; reading a snapshot does not change a fluid.
#include "fluid/snapshot.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "fluid/rig.hpp"

namespace rill::test {
namespace snapshot_test {

constexpr double kFrame = 1.0 / 60;

/// A dam break that chooses its own steps; the fill overlaps, so that it settles first.
Trial dam() {
  Trial t = trial();
  setWalls(t, {0.75, 0.75, 0.375});
  t.x = block({6, 7, 6}, t.d(), {}, 0.1);
  t.v = randomCloud(t.x.size(), 0.5, 9, {1.5, -0.25, -0.25});
  t.step = kFrame;
  t.settle = true;
  t.scene.solver.cfl = 0.25;
  t.scene.solver.tolerance = 0.005;
  return t;
}

Solid moving(Solid solid) {
  solid.motion = {{0, {0, 0, 0}}, {0.03, {-0.02, 0.01, 0}, {0, 0.6, 0, 0.8}}, {0.2, {-0.1, 0.05, 0}, {0.8, 0, 0, 0.6}}};
  return solid;
}

class SnapshotTest : public FluidTest {
 protected:
  /// Fills all buffers with NaN: a pass that reads one which the snapshot does not contain and nothing has written changes the result.
  void poison(const Fluid& fluid) {
    const FluidImpl& impl = implOf(fluid);
    std::vector<const Buffer*> all;
    for (const ArrayRow& row : arrayTable())
      if (row.lifetime == Lifetime::Fluid && row.account != Account::None) all.push_back(&impl.buffer(row.id));
    for (uint32_t c = 1; c < impl.chunks().size(); ++c) all.push_back(&impl.buffer(FluidArray::List, c));
    Graph graph;
    graph.pass("poison", [&](Pass& pass) {
      pass.sideEffect();
      std::vector<BufferRef> refs;
      refs.reserve(all.size());
      for (const Buffer* buffer : all)
        refs.push_back(pass.write(graph.import("any", {.handle = buffer->handle(), .size = buffer->size()}), Use::CopyTarget, true));
      return [refs](Commands& commands) {
        for (BufferRef ref : refs) commands.fill(ref, 0x7fc00001u);
      };
    });
    runGraph(graph);
  }

  static void expectEqual(const FluidSnapshot& a, const FluidSnapshot& b) {
    EXPECT_EQ(a.control, b.control);
    EXPECT_EQ(a.sums, b.sums);
    EXPECT_EQ(a.solids, b.solids);
    EXPECT_TRUE(a.position == b.position && a.velocity == b.velocity && a.warmAcceleration == b.warmAcceleration &&
                a.warmStart == b.warmStart && a.id == b.id);
    EXPECT_TRUE(a.nearSolids == b.nearSolids);
    EXPECT_TRUE(a.neighborCount == b.neighborCount && a.neighbors == b.neighbors && a.cell == b.cell);
    EXPECT_EQ(a, b) << "a member that is not compared above";
  }

  /// A snapshot before the first step and after each of two frames; the fluid created from it advances two more.
  void expectTheSame(const Trial& t) {
    std::vector<Snapshot> untouched;
    auto straight = start(t);
    for (int n = 0; n < 4; ++n) {
      straight->advance(kFrame);
      untouched.push_back(straight->snapshot());
    }
    auto original = start(t);
    for (size_t n = 0; n < 3; ++n) {
      SCOPED_TRACE("after " + std::to_string(n) + " frames");
      const FluidSnapshot saved = original->saved();
      withList_ += hasNeighbors(saved) ? 1 : 0;
      walksGrid_ += std::ranges::any_of(saved.neighborCount, [&](uint32_t neighbors) { return neighbors > saved.listCapacity; });
      auto resumed = start(t, &saved);
      poison(resumed->fluid());
      expectEqual(resumed->saved(), saved);
      const FluidStats there = original->stats(), here = resumed->stats();
      EXPECT_EQ(there.densityErrorMean, here.densityErrorMean);
      EXPECT_EQ(there.time_s, here.time_s);
      for (size_t more = n; more < n + 2 && more < 4; ++more) {
        resumed->advance(kFrame, more % 2 ? 12 : 64);
        EXPECT_EQ(resumed->snapshot(), untouched[more]) << "frame " << more + 1;
      }
      auto unread = start(t, &saved);
      poison(unread->fluid());
      unread->advance(kFrame);
      EXPECT_EQ(unread->snapshot(), untouched[n]) << "without reading its start";
      original->advance(kFrame);
      EXPECT_EQ(original->snapshot(), untouched[n]) << "after its state was read";
    }
  }

  int withList_ = 0, walksGrid_ = 0;  // snapshots with a valid list; with particles that walk the grid
};

TEST_F(SnapshotTest, ContinuesWithEitherNeighborSearch) {
  for (Gather gather : kGathers) {
    SCOPED_TRACE(nameOf(gather));
    Trial t = dam();
    t.gather = gather;
    expectTheSame(t);
  }
  EXPECT_GE(withList_, 3) << "snapshots with a valid list";
}

TEST_F(SnapshotTest, ContinuesWithMovingSolids) {
  Trial t = dam();
  t.scene.solids = {moving(ball({0.55, 0.15, 0.1875}, 0.1)), slab({0.6, 0, 0}, {0.7, 0.2, 0.2})};
  t.scene.solids[0].friction = 0.3;
  expectTheSame(t);
}

TEST_F(SnapshotTest, ContinuesWithForces) {
  for (double viscosity : {1.0, 20.0}) {
    Trial t = dam();
    t.scene.solver.iterations = 3;
    t.scene.fluid.viscosity = viscosity;
    t.scene.fluid.vorticity = 0.3;
    t.scene.fluid.tensile = 0.5;
    t.scene.fluid.surface_tension = viscosity > 1 ? 20 : 0;
    t.scene.gravity_changes = {{0.02, {3, -9, 0}}, {0.045, {0, 5, 1}}};
    t.scene.solids = {moving(ball({0.55, 0.15, 0.1875}, 0.1))};
    expectTheSame(t);
  }
}

TEST_F(SnapshotTest, ContinuesWithoutWalls) {
  Trial t = dam();
  t.scene.domain.reset();
  for (const Gather gather : {Gather::Texel, Gather::Grid}) {  // the grid has no list heads without walls
    SCOPED_TRACE(nameOf(gather));
    t.gather = gather;
    expectTheSame(t);
  }
}

TEST_F(SnapshotTest, ContinuesWithListsThatOverflow) {
  Trial t = dam();
  t.settle = false;
  t.x = randomCloud(400, 5 * t.d(), 7, glm::dvec3(0.03));
  t.v.assign(400, glm::dvec3(0));
  t.scene.solver.max_substeps = 2;  // no more, or they have spread before the first frame is over
  t.scene.solver.cfl = 0.05;
  t.scene.solver.tolerance = 0;
  expectTheSame(t);
  EXPECT_GT(walksGrid_, 0) << "snapshots with particles that walk the grid";
}

TEST_F(SnapshotTest, ContinuesWithInactiveParticles) {
  Trial t = dam();
  t.x[5].x = std::numeric_limits<double>::quiet_NaN();
  expectTheSame(t);
}

// Numbers of particles that index lists which a snapshot does not have: a file may say anything.
TEST_F(SnapshotTest, CountsParticlesInReachAnew) {
  Trial t = dam();
  t.scene.solids = {moving(ball({0.55, 0.15, 0.1875}, 0.1))};
  auto run = start(t);
  run->advance(kFrame);
  FluidSnapshot saved = run->saved();
  saved.sums[offsetof(FluidSums, inReach) / 4] = 0xf0000000u;
  saved.sums[offsetof(FluidSums, reached) / 4] = 0xffffffffu;
  auto resumed = start(t, &saved);
  run->advance(kFrame);
  resumed->advance(kFrame);
  EXPECT_EQ(resumed->snapshot(), run->snapshot());
}

TEST_F(SnapshotTest, RejectsSnapshotOfAnotherFluid) {
  Trial t = dam();
  auto run = start(t);
  run->advance(kFrame);
  const FluidSnapshot saved = run->saved();
  t.x.pop_back();
  t.v.pop_back();
  const ParticleSet fewer = t.particles();
  const Scene scene = t.timedScene();
  const auto made = Fluid::create(rillDevice(), {.scene = &scene, .particles = &fewer, .snapshot = &saved});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, ErrorKind::BadInput);
  EXPECT_NE(made.error().message.find("it has 252 particles; expected at most 251"), std::string::npos) << made.error().message;
}

}  // namespace snapshot_test
}  // namespace rill::test
