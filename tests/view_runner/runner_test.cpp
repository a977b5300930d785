// The simulation of the viewer, without a window. Changes of its scene: runner_changes_test.cpp.
#include "view/playback.hpp"
#include "view_runner/runner_fixture.hpp"

namespace rill::view {
namespace runner_test {

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

}  // namespace runner_test
}  // namespace rill::view
