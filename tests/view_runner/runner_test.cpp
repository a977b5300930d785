// The simulation of the viewer, without a window.
#include "view/runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "rill/offline.hpp"
#include "support/gpu_test.hpp"
#include "support/temporary_folder.hpp"
#include "view/playback.hpp"
#include "view/session.hpp"

namespace rill::view {
namespace {

constexpr const char* kDam = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}]
})";

class ViewRunnerTest : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    file = folder.write("dam.json", kDam);
  }
  Scene scene(std::span<const Override> changes = {}) const {
    auto read = loadScene(file, changes);
    EXPECT_TRUE(read);
    return *read;
  }

  test::TemporaryFolder folder;
  std::filesystem::path file;
};

TEST_F(ViewRunnerTest, StepsEqualCaptureBitwise) {
  constexpr int kSteps = 8;
  auto captured = offline::Simulation::open(scene());
  ASSERT_TRUE(captured) << captured.error().message;
  for (int k = 0; k < kSteps; ++k) ASSERT_TRUE(captured->advance(1.0 / 60));
  auto stats = captured->stats();
  ASSERT_TRUE(stats);
  uint32_t maxPieces = 0;
  for (const double budget : {0.0, 0.004, 1e9}) {
    auto runner = Runner::create(context(), scene());
    ASSERT_TRUE(runner) << runner.error().message;
    while ((*runner)->steps() < kSteps) {
      ASSERT_TRUE((*runner)->advancePiece(budget));
      Graph graph;
      const FluidState shown = (*runner)->present(graph);
      const Ticket ticket = graph.readback(shown.position);
      run(graph);
      const auto positions = read<Float4>(graph, ticket);
      ASSERT_GE(positions.size(), shown.capacity);
      for (uint32_t i = 0; i < shown.capacity; ++i)
        ASSERT_TRUE(positions[i].x >= 0 && positions[i].x <= 1) << "in the tank, between pieces too";
      if (!(*runner)->betweenSteps()) continue;
      maxPieces = std::max(maxPieces, (*runner)->last().pieces);
      ASSERT_TRUE((*runner)->measure()) << "looking changes nothing";
    }
    const auto hash = (*runner)->hash();
    ASSERT_TRUE(hash);
    EXPECT_EQ(*hash, stats->stateHash) << budget;
    EXPECT_NEAR((*runner)->time_s(), kSteps / 60.0, 1e-6);
  }
  EXPECT_GT(maxPieces, 1u) << "some of them were cut";
}

// Foam, spray and bubbles are those of a capture, and survive a change of the fluid.
TEST_F(ViewRunnerTest, WhitewaterEqualsCaptureBitwise) {
  constexpr uint64_t kSteps = 30;
  const std::vector<Override> changes{{"rill", "0.2"}, {"look.whitewater", "true"}};
  auto captured = offline::Simulation::open(scene(changes));
  ASSERT_TRUE(captured) << captured.error().message;
  for (uint64_t k = 0; k < kSteps; ++k) ASSERT_TRUE(captured->advance(1.0 / 60));
  const auto stats = captured->stats();
  ASSERT_TRUE(stats);
  const auto expected = captured->checkpoint();
  ASSERT_TRUE(expected);
  ASSERT_GT(expected->whitewater.place.size(), 100u);
  auto runner = Runner::create(context(), scene(changes));
  ASSERT_TRUE(runner) << runner.error().message;
  while ((*runner)->steps() < kSteps) ASSERT_TRUE((*runner)->advancePiece(0.004, (*runner)->steps() + 1 < kSteps));
  const auto white = (*runner)->whitewater();
  ASSERT_TRUE(white) << white.error().message;
  EXPECT_EQ(*white, expected->whitewater);
  const auto hash = (*runner)->hash();
  ASSERT_TRUE(hash);
  EXPECT_EQ(*hash, stats->stateHash);

  Scene changed = (*runner)->scene();
  changed.fluid.viscosity = 0.01;
  ASSERT_TRUE((*runner)->change(changed));
  const auto kept = (*runner)->whitewater();
  ASSERT_TRUE(kept);
  EXPECT_EQ(*kept, *white);
  auto restarted = Runner::create(context(), scene());
  ASSERT_TRUE(restarted);
  ASSERT_TRUE((*restarted)->step());
  EXPECT_TRUE((*restarted)->whitewater()->counts.empty()) << "absent without look.whitewater";
}

TEST_F(ViewRunnerTest, QueuedStepsEqualCaptureBitwise) {
  constexpr uint64_t kSteps = 9;
  auto captured = offline::Simulation::open(scene());
  ASSERT_TRUE(captured);
  for (uint64_t k = 0; k < kSteps; ++k) ASSERT_TRUE(captured->advance(1.0 / 60));
  const auto stats = captured->stats();
  ASSERT_TRUE(stats);
  for (const double budget : {0.0, 0.002, 1e9}) {
    auto runner = Runner::create(context(), scene());
    ASSERT_TRUE(runner) << runner.error().message;
    while ((*runner)->steps() < kSteps) {
      const bool more = (*runner)->begun() < kSteps && !((*runner)->betweenSteps() && (*runner)->begun() + 1 == kSteps);
      ASSERT_TRUE((*runner)->advancePiece(budget, more));
      Graph graph;  // a picture between the pieces
      static_cast<void>(graph.readback((*runner)->present(graph).position));
      ASSERT_TRUE(context().run(graph));
    }
    EXPECT_TRUE((*runner)->betweenSteps());
    const auto hash = (*runner)->hash();
    ASSERT_TRUE(hash);
    EXPECT_EQ(*hash, stats->stateHash) << budget;
  }
}

// On a machine that never reaches real time.
TEST_F(ViewRunnerTest, PlaybackCountsTheStepsOfTheDevice) {
  auto runner = Runner::create(context(), scene());
  ASSERT_TRUE(runner) << runner.error().message;
  Playback playback;
  uint64_t ended = 0;
  Playback::Frame frame{.passed_s = 0.2, .budget_s = 1e-9};
  for (int k = 0; k < 60; ++k, frame.now_s += frame.passed_s) {
    const auto done = playback.advance(**runner, frame);
    ASSERT_TRUE(done) << done.error().message;
    ended += *done;
    if (k == 40) frame.paused = true;
  }
  EXPECT_TRUE((*runner)->betweenSteps()) << "paused";
  EXPECT_GE(ended, 3u);
  EXPECT_EQ((*runner)->steps(), ended);
  auto captured = offline::Simulation::open(scene());
  ASSERT_TRUE(captured);
  for (uint64_t k = 0; k < ended; ++k) ASSERT_TRUE(captured->advance(1.0 / 60));
  const auto hash = (*runner)->hash();
  ASSERT_TRUE(hash);
  EXPECT_EQ(*hash, captured->stats()->stateHash);
}

TEST_F(ViewRunnerTest, ResumesOnAnotherDeviceBitwise) {
  auto runner = Runner::create(context(), scene());
  ASSERT_TRUE(runner) << runner.error().message;
  EXPECT_FALSE((*runner)->kept().snapshot) << "the start";
  for (int k = 0; k < 4; ++k) ASSERT_TRUE((*runner)->step());
  ASSERT_TRUE((*runner)->keep());
  const KeptState kept = (*runner)->kept();
  for (int k = 0; k < 3; ++k) ASSERT_TRUE((*runner)->step());
  auto other = offline::Context::create({.validation = true});
  ASSERT_TRUE(other) << other.error().message;
  {
    auto resumed = Runner::resume(*other, kept);
    ASSERT_TRUE(resumed) << resumed.error().message;
    EXPECT_EQ((*resumed)->steps(), 4u);
    EXPECT_NEAR((*resumed)->time_s(), 4 / 60.0, 1e-6);
    EXPECT_TRUE((*resumed)->kept().snapshot) << "for the next loss";
    for (int k = 0; k < 3; ++k) ASSERT_TRUE((*resumed)->step());
    const auto straight = (*runner)->hash(), again = (*resumed)->hash();
    ASSERT_TRUE(straight && again);
    EXPECT_EQ(*straight, *again);
  }
  EXPECT_EQ(other->takeMessages(), std::vector<std::string>());
}

TEST(ViewContext, RejectsDeviceWithoutPresentation) {
  offline::ContextDesc desc;
  uint32_t asked = 0;
  desc.presents = [&](VkInstance, VkPhysicalDevice, uint32_t) {
    ++asked;
    return false;
  };
  const auto none = offline::Context::create(desc);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::NoDevice);
  EXPECT_NE(none.error().message.find("presentation"), std::string::npos) << none.error().message;
  EXPECT_GT(asked, 0u);
  desc.presents = [](VkInstance, VkPhysicalDevice, uint32_t) { return true; };
  EXPECT_TRUE(offline::Context::create(desc));
}

TEST_F(ViewRunnerTest, RunsEmptyScene) {
  Scene empty = scene();
  empty.fill.clear();
  auto runner = Runner::create(context(), empty);
  ASSERT_TRUE(runner) << runner.error().message;
  for (int k = 0; k < 3; ++k) ASSERT_TRUE((*runner)->step());
  EXPECT_NEAR((*runner)->time_s(), 0.05, 1e-12);
  EXPECT_TRUE((*runner)->measure());
}

TEST_F(ViewRunnerTest, LiveChangeContinuesFromCurrentState) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session) << session.error().message;
  Session& s = **session;
  for (int k = 0; k < 6; ++k) ASSERT_TRUE(s.runner().step());
  const auto before = s.runner().measure();
  ASSERT_TRUE(before);
  ASSERT_TRUE(s.isLive("gravity"));
  const auto changed = s.change({"gravity", "[4, 0, 0]"});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(s.runner().steps(), 6u);
  const auto at = s.runner().measure();
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->time_s, before->time_s, 1e-6);
  EXPECT_NEAR(at->kinetic_J, before->kinetic_J, 1e-6 * before->kinetic_J + 1e-9) << "nothing has moved";
  ASSERT_TRUE(s.runner().step());
  const auto after = s.runner().measure();
  ASSERT_TRUE(after);
  // 75 kg in free fall along x for a step: 5 kg m/s more, but for what the walls take.
  const double mass = 1000 * 0.05 * 0.05 * 0.05 * 600;
  const double gained = after->momentum[0] - at->momentum[0], lostDown = after->momentum[1] - at->momentum[1];
  EXPECT_GT(gained, 0.5 * mass * 4 / 60);
  EXPECT_GT(lostDown, -0.2 * mass * 9.81 / 60) << "nothing pulls down any more";

  ASSERT_TRUE(s.change({"fluid.viscosity", "20"}));
  ASSERT_TRUE(s.change({"solver.iterations", "2"}));
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(s.runner().step());
  EXPECT_EQ(s.runner().steps(), 12u);
  EXPECT_EQ(s.scene().fluid.viscosity, 20);
  const auto end = s.runner().measure();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->nonFinite, 0u);
  EXPECT_EQ(end->outside, 0u);
  EXPECT_LT(end->densityErrorMean, 0.01);
}

// Mud stiffens and flows again; what the passes of shear need is not in the state before.
TEST_F(ViewRunnerTest, YieldStressChangesWhileFluidFlows) {
  std::string text = kDam;
  auto session = Session::open(context(), folder.write("mud.json", text.replace(text.find("0.1"), 3, "0.2")));
  ASSERT_TRUE(session) << session.error().message;
  Session& s = **session;
  std::ptrdiff_t shears = 0;  // passes, in the last step
  const auto kineticAfter = [&](int steps) {
    for (int k = 0; k < steps; ++k) EXPECT_TRUE(s.runner().step());
    shears = std::ranges::count(s.runner().fluid().passRuns(), "viscosity by shear", &FluidPassRuns::name);
    const auto stats = s.runner().measure();
    EXPECT_TRUE(stats);
    if (!stats) return 0.0;
    EXPECT_EQ(stats->nonFinite + stats->outside, 0u);
    return stats->kinetic_J;
  };
  const double flows = kineticAfter(6);
  ASSERT_TRUE(s.isLive("fluid.yield_stress"));
  ASSERT_TRUE(s.change({"fluid.yield_stress", "20000"}));
  const double stands = kineticAfter(6);
  EXPECT_EQ(shears, 1);
  EXPECT_LT(stands, 0.01 * flows);
  ASSERT_TRUE(s.reset("fluid.yield_stress"));
  EXPECT_GT(kineticAfter(6), 10 * stands);
  EXPECT_EQ(shears, 0);
  EXPECT_EQ(s.runner().steps(), 18u);

  EXPECT_FALSE(s.isLive("fluid.surface_tension")) << "lists of neighbors are longer with it";
  ASSERT_TRUE(s.change({"fluid.surface_tension", "10"}));
  EXPECT_EQ(s.runner().steps(), 0u);
  ASSERT_TRUE(s.isLive("fluid.contact_angle"));
  EXPECT_GT(kineticAfter(2), 0);
  ASSERT_TRUE(s.change({"fluid.contact_angle", "20"}));
  EXPECT_GT(kineticAfter(2), 0);
  EXPECT_EQ(s.runner().steps(), 4u);
}

TEST_F(ViewRunnerTest, InvalidChangeHasNoEffect) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  Session& s = **session;
  ASSERT_TRUE(s.runner().step());
  for (const Override& bad :
       {Override{"fluid.viscosity", "-1"}, {"fluid.spacing", "0"}, {"solver.nonsense", "1"}, {"fluid.spacing", "1e-5"}}) {
    const auto changed = s.change(bad);
    ASSERT_FALSE(changed) << bad.key;
    EXPECT_FALSE(s.isChanged(bad.key));
    EXPECT_EQ(s.runner().steps(), 1u);
  }
  EXPECT_TRUE(s.runner().step());
}

TEST_F(ViewRunnerTest, OtherChangesRestartAndResetRestores) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  Session& s = **session;
  ASSERT_TRUE(s.runner().step());
  EXPECT_FALSE(s.isLive("fluid.spacing"));
  ASSERT_TRUE(s.change({"fluid.spacing", "0.1"}));
  EXPECT_EQ(s.runner().steps(), 0u);
  EXPECT_EQ(s.runner().fluid().count(), 75u);
  EXPECT_TRUE(s.isChanged("fluid.spacing"));
  ASSERT_TRUE(s.reset("fluid.spacing"));
  EXPECT_EQ(s.runner().fluid().count(), 600u);
  EXPECT_TRUE(s.changes().empty());
}

TEST_F(ViewRunnerTest, SavedSceneContainsChanges) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  ASSERT_TRUE((*session)->change({"fluid.viscosity", "0.25"}));
  ASSERT_TRUE((*session)->change({"solver.time_step", "\"auto\""}));
  ASSERT_TRUE((*session)->change({"look.preset", "milk"}));
  const auto text = (*session)->text(folder.path());
  ASSERT_TRUE(text) << text.error().message;
  const auto saved = loadScene(folder.write("saved.json", *text));
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->fluid.viscosity, 0.25);
  EXPECT_EQ(saved->look.preset, "milk");
  EXPECT_FALSE(saved->solver.time_step);
  EXPECT_EQ(saved->fluid.spacing, 0.05);
}

TEST_F(ViewRunnerTest, SavedSceneHasRelativePaths) {
  const test::TemporaryFolder elsewhere;
  folder.write("sky.hdr", "x");
  folder.write("water.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n.5 .5 .1\n");
  elsewhere.write("other.hdr", "x");
  const auto named = folder.write("named.json", R"({
    "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
    "fill": [{"particles": {"file": "water.ply"}}], "look": {"environment": "sky.hdr"}
  })");
  auto session = Session::open(context(), named);
  ASSERT_TRUE(session) << session.error().message;
  const auto saved = [&] {
    const auto text = (*session)->text(elsewhere.path());
    EXPECT_TRUE(text) << text.error().message;
    const auto scene = loadScene(elsewhere.write("saved.json", *text));
    EXPECT_TRUE(scene) << scene.error().message;
    return *scene;
  };
  EXPECT_TRUE(std::filesystem::equivalent(saved().look.environment, folder / "sky.hdr"));
  EXPECT_TRUE(std::filesystem::equivalent(std::get<ParticleFile>(saved().fill[0].shape).file, folder / "water.ply"));
  const auto fromHere = std::filesystem::relative(elsewhere / "other.hdr");
  ASSERT_TRUE((*session)->change({"look.environment", fromHere.string()}));
  EXPECT_TRUE(std::filesystem::equivalent(saved().look.environment, elsewhere / "other.hdr"));
}

TEST_F(ViewRunnerTest, ReloadsChangedFileAndKeepsSceneWhenInvalid) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  Session& s = **session;
  EXPECT_FALSE(s.fileChanged(1));
  folder.write("dam.json", "{ broken");
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(3));
  EXPECT_FALSE(s.fileChanged(1.2)) << "not asked more than twice a second";
  EXPECT_TRUE(s.fileChanged(2));
  const auto again = s.reload();
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("dam.json"), std::string::npos);
  EXPECT_FALSE(s.fileChanged(3)) << "reported once";
  EXPECT_TRUE(s.runner().step());
  // What is done to the scene meanwhile goes on from the text that it was read from.
  EXPECT_TRUE(s.change({"fluid.viscosity", "0.5"}));
  EXPECT_TRUE(s.restart());
  EXPECT_EQ(s.scene().fluid.viscosity, 0.5);
  folder.write("dam.json", std::string(kDam).replace(std::string(kDam).find("0.05"), 4, "0.10"));
  ASSERT_TRUE(s.reload());
  EXPECT_EQ(s.scene().fluid.spacing, 0.1);
  EXPECT_EQ(s.scene().fluid.viscosity, 0.5);
}

}  // namespace
}  // namespace rill::view
