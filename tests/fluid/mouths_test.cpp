// What open mouths do to fluid beside them, against the reference, until their first layers are born.
#include "fluid/flows_fixture.hpp"
#include "support/flat_meshes.hpp"

namespace rill::test {
namespace mouths_test {

using flows_test::disc;
using flows_test::turn;

/// Fluid around a mouth in its middle, which has let out three tenths of a layer after eight substeps.
Trial fluidAround(const Emitter& emitter) {
  Trial t = trial();
  t.scene.solver.tolerance = 0;
  t.scene.emitters = {emitter};
  t.x = block({8, 8, 8}, t.d(), glm::dvec3(-4 * t.d()), 0.2);
  t.capacity = 600;
  return t;
}

double slowSpeed(const Trial& t) { return 0.3 * t.d() / (8 * t.step); }

class MouthsTest : public FluidTest {
 protected:
  /// The reference differs without the mouth, by more than the device may.
  void expectActs(const Trial& t) {
    Trial without = t;
    without.scene.emitters.clear();
    if (without.scene.domain) without.scene.domain->inflow.reset();
    Oracle with(t), other(without);
    with.advance(8);
    other.advance(8);
    double most = 0;
    for (size_t i = 0; i < t.x.size(); ++i)
      most = std::max(most, glm::length(with.solver().state.position[i] - other.solver().state.position[i]));
    EXPECT_GT(most, 0.05 * t.d());
  }

  /// It does, and the device does the same; `ageing` as in expectEqual().
  void expectActsAsReference(const Trial& t, double ageing = 1e-3) {
    expectActs(t);
    expectEqual(t, 8, 2e-4, 2e-3, ageing);
  }
};

TEST_F(MouthsTest, DiscMatchesReference) {
  Trial t = fluidAround(disc({0, 0, 0}, 0.12, {1, 2, 0.5}, 1));
  t.scene.emitters[0].speed = slowSpeed(t);
  expectActsAsReference(t);
}

TEST_F(MouthsTest, DiscThatOpensWithinAnAdvanceMatchesReference) {
  Trial t = fluidAround(disc({0, 0, 0}, 0.12, {0, 0, 1}, 1));
  t.scene.emitters[0].speed = 2 * slowSpeed(t);
  t.scene.emitters[0].from = 2.5 * t.step;
  expectActsAsReference(t, 2e-3);
}

TEST_F(MouthsTest, DiscThatReachesThroughAWallMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 0.5});
  t.scene.solver.tolerance = 0;
  t.scene.emitters = {disc({0.29, 0.31 * t.d(), 0.247}, 0.15, {1, 0.03, 0.02}, 1)};
  t.scene.emitters[0].speed = slowSpeed(t);
  t.x = block({10, 6, 8}, t.d(), {}, 0.1, 3);
  t.capacity = 600;
  expectActsAsReference(t, 2e-3);
}

TEST_F(MouthsTest, RectangleThatTurnsMatchesReference) {
  Trial t = fluidAround({.mouth = RectMouth{{0, 0, 0}, {0.26, 0.13}, {0, -1, 0}, {1, 0, 1}}});
  t.scene.emitters[0].speed = slowSpeed(t);
  t.scene.emitters[0].motion = {{.at = 0}, {.at = 0.02, .translate = {0.01, 0, 0.02}, .rotate = turn({0, 0, 1}, 0.3)}};
  expectActsAsReference(t);
}

// Of a mesh, what displaces and pushes are the squares and points of its lattice: the notch stays open.
TEST_F(MouthsTest, MeshThatTurnsMatchesReference) {
  Trial t = fluidAround({.mouth = mouthOf(moved(cornerMesh(0.15), -0.1, -0.05))});
  t.scene.emitters[0].speed = slowSpeed(t);
  t.scene.emitters[0].motion = {{.at = 0}, {.at = 0.02, .translate = {0.01, 0, 0.02}, .rotate = turn({0, 1, 0}, 0.3)}};
  expectActsAsReference(t, 2e-3);
}

// Images of the fluid in the mouth stand behind the walls that it lies beside, and beside a solid the two are one.
TEST_F(MouthsTest, InflowBesideWallsAndASolidMatchesReference) {
  Trial t = trial();
  setWalls(t, {1, 1, 0.5});
  t.scene.solver.tolerance = 0;
  t.scene.solids = {slab({0, 0, 0}, {0.25, 0.1, 0.2})};
  t.scene.domain->inflow = Inflow{.side = Axis::MinusX, .level = 0.3, .speed = slowSpeed(t)};
  addOutsideSolids(t, block({6, 6, 8}, t.d(), {t.d(), 0, 0}, 0.05));
  t.capacity = 1000;
  expectActsAsReference(t);
}

// Iterations take the mouth's density, too.
TEST_F(MouthsTest, SeveralIterationsMatchReference) {
  Trial t = fluidAround(disc({0, 0, 0}, 0.15, {0, 1, 0}, 1));
  t.scene.emitters[0].speed = slowSpeed(t);
  t.scene.solver.iterations = 3;
  expectEqual(t, 8, 4e-4, 4e-3);
}

// Water under its own weight that flows in keeps the speed of the inflow at any step: what has left the mouth is held by what follows.
TEST_F(MouthsTest, InflowUnderItsOwnWeightKeepsItsSpeedAtAnyStep) {
  for (const double step : {1e-3, 0.25e-3}) {
    Trial t = trial();
    t.scene.fluid.spacing = 0.02;
    t.scene.solver = SolverSettings{};
    setWalls(t, {1.2, 0.3, 0.12}, SideMask{1u << sideBit(Axis::PlusX)});
    t.scene.domain->open_removes = true;
    t.scene.domain->inflow = Inflow{.side = Axis::MinusX, .level = 0.1, .speed = 3};
    t.capacity = 4000;
    t.step = step;
    auto run = start(t);
    for (int frame = 0; frame < 15; ++frame) run->advance(1.0 / 60);
    const Snapshot after = run->snapshot();
    double most = 0;
    size_t behind = 0;  // the front, which falls like a dam's
    for (size_t i = 0; i < after.x.size(); ++i) {
      if (!(after.x[i].x < 0.3)) continue;
      most = std::max(most, glm::length(after.v[i] - glm::dvec3(3, 0, 0)));
      ++behind;
    }
    EXPECT_GT(behind, 400u);
    EXPECT_LT(most, 0.15) << "step " << step;
    EXPECT_LT(run->stats().densityErrorMax, 0.01) << "step " << step;
  }
}

// The list of particles near mouths follows a mouth that the host has moved, in an advance of no time, too.
TEST_F(MouthsTest, ActsWhereTheHostHasMovedIt) {
  Trial t = fluidAround(disc({5, 0, 0}, 0.12, {1, 0, 0}, 1));
  const double flow = slowSpeed(t) * mouthLattice(t.scene.emitters[0].mouth, t.d()).area;
  std::vector<Snapshot> ends;
  for (const double first : {0.0, 8 * t.step}) {
    auto run = start(t);
    run->substeps(2);
    run->emitters = {{.flow = flow, .center = Double3{0, 0, 0}}};
    if (first == 0) run->advance(0);
    run->advance(8 * t.step);
    ends.push_back(run->snapshot());
  }
  auto away = start(t);
  away->substeps(10);
  double acts = 0, differs = 0;
  const Snapshot still = away->snapshot();
  for (size_t i = 0; i < t.x.size(); ++i) {
    acts = std::max(acts, glm::length(ends[0].x[i] - still.x[i]));
    differs = std::max(differs, glm::length(ends[0].x[i] - ends[1].x[i]));
  }
  EXPECT_GT(acts, 0.05 * t.d());
  EXPECT_LT(differs, 1e-3 * t.d());
}

// A tap that is drawn on a wall works as an inflow does: its layers do not wait at the wall for the first half spacing.
TEST_F(MouthsTest, MouthOnAWallEqualsOneHalfASpacingOffIt) {
  std::vector<Snapshot> ends;
  for (const double off : {0.0, 0.5}) {
    Trial t = trial();
    setWalls(t, {1, 1, 0.5});
    t.scene.emitters = {{.mouth = RectMouth{{off * t.d(), 0.5, 0.25}, {0.25, 0.25}, {1, 0, 0}}, .speed = 1}};
    t.capacity = 1000;
    auto run = start(t);
    run->advance(0.2);
    ends.push_back(run->snapshot());
  }
  EXPECT_GT(ends[0].x.size(), 30u);
  EXPECT_EQ(ends[0], ends[1]);
}

}  // namespace mouths_test
}  // namespace rill::test
