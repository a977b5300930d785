// Features side by side: surface tension, yield stress and several fluids with emitters, drains, bodies and sleep, and in lists of
// several chunks.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "fluid/rig.hpp"
#include "fluid/sleep.hpp"
#include "fluid/sleeping_trial.hpp"
#include "fluid/snapshot.hpp"
#include "support/meshes.hpp"

namespace rill::test {
namespace combinations_test {

constexpr double kFrame = 1.0 / 60;
constexpr uint32_t kPiece = 6;  // substeps recorded: many more are empty with a yield stress, whose solve has 64 steps

struct Fed {
  const char* name;
  Trial trial;
};

/// A drop or heap on the floor, beside a ball, that an emitter feeds and a drain empties.
Trial fedHeap() {
  Trial t = trial();
  t.scene.solver.cfl = 0.3;
  setWalls(t, {1, 1, 1});
  t.scene.solids = {ball({0.75, 0.1, 0.5}, 0.1)};
  addOutsideSolids(t, block({6, 4, 6}, t.d(), {0.3, 0, 0.3}, 0.05));
  t.scene.emitters = {{.mouth = DiscMouth{.center = {0.4, 0.7, 0.5}, .radius = 0.1, .normal = {0, -1, 0}}, .speed = 4}};
  t.scene.drains = {{.shape = SphereShape{{0.5, 0.05, 0.5}, 0.1}, .from = 0.03}};
  t.capacity = 400;
  t.step = 4e-3;
  return t;
}

std::vector<Fed> fedHeaps() {
  Fed tension{"tension", fedHeap()}, yield{"yield stress", fedHeap()}, several{"several fluids", fedHeap()};
  tension.trial.scene.fluid.surface_tension = 20;
  tension.trial.scene.fluid.contact_angle = 60;
  yield.trial.scene.fluid.yield_stress = 50;
  yield.trial.scene.fluid.viscosity = 5;
  yield.trial.scene.fluid.flow_index = 0.6;
  Trial& t = several.trial;
  t.scene.fluids = {{.name = "water", .surface_tension = 20},
                    {.name = "mud", .density = 1500, .viscosity = 5, .yield_stress = 50},
                    {.name = "oil", .density = 800, .viscosity = 0.1}};
  t.scene.interfaces = {{.between = {"water", "oil"}, .tension = 10}};
  for (size_t i = 0; i < t.x.size(); ++i) t.fluids.push_back(t.x[i].x < 0.5 ? 0 : 1);
  t.scene.emitters[0].fluid = "oil";
  Solid box = slab({0.1, 0.3, 0.1}, {0.25, 0.45, 0.25});
  box.body = Body{.density = 500};
  t.scene.solids.push_back(box);
  return {tension, yield, several};
}

class CombinationsTest : public FluidTest {
 protected:
  /// Frames of 1/60 s; the ledger adds up in each.
  void frames(Run& run, int count) {
    for (int frame = 0; frame < count; ++frame) {
      run.advance(kFrame, kPiece);
      const FluidStats s = run.stats();
      EXPECT_EQ(s.ledger.filled + s.ledger.emitted, s.particles + s.ledger.drained + s.ledger.left + s.ledger.inactive);
      EXPECT_EQ(s.nonFinite, 0u);
      EXPECT_EQ(s.outside, 0u);
      EXPECT_TRUE(run.measured().finite());
    }
  }
};

// Whether the host knows of the frames before or not, and across a checkpoint while the emitter runs.
TEST_F(CombinationsTest, EmittersAndDrainsRunWithTheSameBitsInAnyFrames) {
  for (const auto& [name, trial] : fedHeaps()) {
    SCOPED_TRACE(name);
    auto waited = start(trial);
    frames(*waited, 3);
    const FluidSnapshot middle = waited->saved();
    frames(*waited, 3);
    const FluidSnapshot end = waited->saved();
    const FluidLedger ledger = waited->stats().ledger;
    EXPECT_GT(ledger.emitted, 40u);
    EXPECT_GT(ledger.drained, 10u);

    auto ahead = start(trial);
    for (int frame = 0; frame < 6; frame += 3) {
      Graph graphs[3];
      std::vector<Graph*> all;
      for (Graph& graph : graphs) {
        ahead->fluid().addTo(graph, {.advance_s = kFrame, .substeps = 8 * kPiece});
        all.push_back(&graph);
      }
      runGraphs(all);
      ASSERT_EQ(ahead->progress().timeLeft_s, 0) << "the frames were not recorded to their ends";
    }
    EXPECT_EQ(firstDifference(ahead->saved(), end), "");

    auto resumed = start(trial, &middle);
    frames(*resumed, 3);
    EXPECT_EQ(firstDifference(resumed->saved(), end), "");
  }
}

TEST_F(CombinationsTest, EmittersAndDrainsRunInEveryWayToGather) {
  for (auto& [name, trial] : fedHeaps())
    for (const Gather gather : {Gather::Storage, Gather::Grid}) {
      SCOPED_TRACE(std::string(name) + ", " + nameOf(gather));
      trial.gather = gather;
      frames(*start(trial), 4);
    }
}

// A jet in space, which pulls itself and a drop beside it together: sideways no momentum comes from anywhere.
TEST_F(CombinationsTest, TensionOfAJetConservesMomentum) {
  Trial t = trial();
  const glm::dvec3 along{0.6, 0, 0.8};
  t.scene.gravity = {0, 0, 0};
  t.scene.fluid.surface_tension = 40;
  t.scene.emitters = {
      {.mouth = RectMouth{.center = {0, 0, 0}, .size = {0.5, 0.07}, .normal = {along.x, 0, along.z}, .up = {0, 1, 0}}, .speed = 1}};
  t.x = block({4, 5, 3}, t.d(), {-0.2, 0.06, 0.27}, 0.05);
  t.capacity = 400;
  t.step = 2e-3;
  forEachGather(t, 100, [&](Run& run) {
    const Snapshot s = run.snapshot();
    const auto across = [&](const glm::dvec3& v) { return glm::length(v - glm::dot(v, along) * along); };
    double moving = 0;
    for (const glm::dvec3& v : s.v) moving += across(v);
    EXPECT_GT(moving, 0.05 * double(s.v.size())) << "it contracts";
    EXPECT_LT(across(s.velocitySum()), 2e-4 * moving);
  });
}

TEST_F(CombinationsTest, ChunksOfListsChangeNoBit) {
  for (const bool tension : {true, false}) {
    SCOPED_TRACE(tension ? "tension" : "yield stress");
    Trial t = trial();
    (tension ? t.scene.fluid.surface_tension : t.scene.fluid.yield_stress) = 200;
    t.x = block({24, 20, 17}, t.d(), {}, 0.1);
    t.capacity = 3 * kListBlock + 100;
    if (tension) {  // which solids feel
      t.scene.solids = {slab({0.2, -0.5, 0.2}, {1, 0.1, 1}), ball({0.7, 1.5, 0.7}, 0.2)};
      t.scene.solids[1].body = Body{.density = 500};
      t.loads = true;
    }
    t.scene.emitters = {{.mouth = DiscMouth{.center = {0.7, 2, 0.7}, .radius = 0.3, .normal = {0, -1, 0}}, .speed = 30}};
    const auto end = [&](Run& run, size_t chunks) {
      EXPECT_EQ(implOf(run.fluid()).chunks().size(), chunks);
      run.substeps(4, kPiece);
      return run.saved();
    };
    auto whole = start(t);
    const uint64_t block = uint64_t{kListBlock} * implOf(whole->fluid()).setup.params.listCapacity * kListEntryBytes;
    const FluidSnapshot expected = end(*whole, 1);
    EXPECT_GT(expected.id.size(), size_t{2} * kListBlock) << "births begin a third chunk";
    const SmallBuffers small(*this, std::max(block, uint64_t{1} << 20));  // of one block; transients need a MiB
    EXPECT_EQ(firstDifference(expected, end(*start(t), 4)), "");
  }
}

TEST_F(CombinationsTest, TensionLeavesInactiveParticlesOut) {
  Trial t = trial();
  t.scene.gravity = {0, 0, 0};
  t.scene.fluid.surface_tension = 20;
  t.x = block({9, 5, 9}, t.d());
  Trial more = t;
  for (int k = 0; k < 3; ++k) more.x.push_back(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
  for (const Gather gather : kGathers) {
    SCOPED_TRACE(nameOf(gather));
    t.gather = more.gather = gather;
    auto run = start(more), alone = start(t);
    run->substeps(20);
    alone->substeps(20);
    Snapshot all = run->snapshot();
    all.x.resize(t.x.size());
    all.v.resize(t.x.size());
    EXPECT_EQ(all.x, alone->snapshot().x);
    EXPECT_EQ(all.v, alone->snapshot().v);
    EXPECT_EQ(run->stats().ledger.inactive, 3u);
    EXPECT_GT(alone->snapshot().fastest(), 0.1) << "it contracts";
  }
}

// The displacement that follows its viscosity comes after the contact with walls.
TEST_F(CombinationsTest, ThinWallsHoldMud) {
  for (const bool sheet : {false, true})
    for (const double yieldStress : {20.0, 1e4}) {
      SCOPED_TRACE(std::string(sheet ? "sheet, " : "cup, ") + std::to_string(yieldStress));
      Trial t = trial();
      const double d = t.d(), inside = 8 * d;
      const Double3 high{inside, 40 * d, inside};
      t.scene.fluid.yield_stress = yieldStress;
      t.scene.fluid.viscosity = 5;
      t.scene.solver.cfl = 0.3;
      for (int k = 1; k < 6; ++k) t.scene.gravity_changes.push_back({0.05 * k, {40 * std::sin(2.1 * k), -9.81, 40 * std::cos(3.3 * k)}});
      t.scene.solids = {{.shape = MeshShape{.two_sided = sheet, .mesh = meshOf(sheet ? openBox({}, high) : cupMesh({}, high, d), sheet)}}};
      t.x = block({7, 5, 7}, d, {0.5 * d, 0.5 * d, 0.5 * d});
      t.v.assign(t.x.size(), {6, -1, 5});
      t.step = kFrame;
      auto run = start(t);
      frames(*run, 16);
      for (const glm::dvec3& x : run->snapshot().x) {
        EXPECT_GT(std::min({x.x, x.y, x.z}), 0);
        EXPECT_LT(std::max(x.x, x.z), inside);
      }
    }
}

/// Mud whose yield stress bears a layer or so, so soft that it may sleep.
Trial softMud(glm::ivec3 room, int layers) {
  Trial t = sleepingTrial(room, layers, kFrame);
  t.scene.fluid.yield_stress = 0.5;
  t.scene.fluid.viscosity = 0.01;
  t.scene.gravity_changes = {{1000, {2, -9.81, 0}}};  // bounds follow the strongest gravity: they stay the same with another time
  return t;
}

TEST_F(CombinationsTest, MudSleepsAndWakes) {
  Trial t = softMud({6, 12, 6}, 5);
  auto run = start(t);
  for (int frame = 0; frame < 600 && !run->progress().asleep; ++frame) run->advance(kFrame, kPiece);
  ASSERT_TRUE(run->progress().asleep);
  const FluidSnapshot state = run->saved();
  t.scene.gravity_changes[0].at = run->progress().time_s + 1.5 * kFrame;
  run = start(t, &state);
  run->advance(kFrame, kPiece);
  EXPECT_TRUE(run->progress().asleep);
  run->advance(4 * kFrame, kPiece);
  EXPECT_FALSE(run->progress().asleep);
  EXPECT_GT(run->snapshot().velocitySum().x, 0);
  EXPECT_EQ(run->stats().viscosityBoundHits, 0u);
}

// Beside mud that moves, which particles that sleep hold as if they stood.
TEST_F(CombinationsTest, RegionsOfMudSleepWithTheSameBitsAcrossACheckpoint) {
  Trial t = softMud({80, 16, 4}, 2);
  t.capacity = static_cast<uint32_t>(t.x.size()) + 100;
  t.scene.emitters = {
      {.mouth = DiscMouth{.center = {0.06, 0.2, 0.04}, .radius = 0.02, .normal = {0, -1, 0}}, .flow = 1e-4, .from = 3, .until = 4}};
  auto run = start(t);
  for (int frame = 0; frame < 180; ++frame) run->advance(kFrame, kPiece);
  EXPECT_EQ(run->stats().sleeping, t.x.size());
  for (int frame = 0; frame < 15; ++frame) run->advance(kFrame, kPiece);
  const FluidSnapshot middle = run->saved();
  for (const uint32_t zone : {kZoneMoves, kZoneWatched, kZoneStill, kZoneAsleep})
    EXPECT_GT(std::ranges::count(middle.rest, zone), 50) << zone;
  EXPECT_GT(run->stats().maxSpeed, 0.05);
  EXPECT_EQ(run->stats().viscosityBoundHits, 0u);
  auto resumed = start(t, &middle);
  run->advance(6 * kFrame, kPiece);
  resumed->advance(6 * kFrame, 2 * kPiece);
  EXPECT_EQ(firstDifference(run->saved(), resumed->saved()), "");
}

// Emitters of the second fluid and bodies among them.
TEST_F(CombinationsTest, SleepHasNoEffectOnSeveralFluids) {
  Trial t = fedHeaps()[2].trial;
  const auto ends = [&](bool sleep) {
    t.scene.solver.sleep = sleep;
    auto run = start(t);
    EXPECT_EQ(std::ranges::count(run->fluid().warnings(), "solver.sleep: has no effect in a scene with several fluids"), sleep ? 1 : 0);
    frames(*run, 4);
    EXPECT_EQ(run->stats().sleeping, std::nullopt);
    for (const FluidPassRuns& runs : run->fluid().passRuns()) EXPECT_EQ(runs.name.find("asleep"), std::string_view::npos) << runs.name;
    return std::pair(run->saved(), run->fluid().memory().total());
  };
  const auto never = ends(false), asked = ends(true);
  EXPECT_EQ(firstDifference(never.first, asked.first), "");
  EXPECT_EQ(never.second, asked.second);
  const Scene sleeps = t.scene;
  t.scene.solver.sleep = false;
  EXPECT_EQ(fluidMemory(sleeps, 1000000).total(), fluidMemory(t.scene, 1000000).total());
}

}  // namespace combinations_test
}  // namespace rill::test
