// Pieces of advances are submitted before the last is known.
#include "offline/advances.hpp"

#include <gtest/gtest.h>

#include "offline/readout.hpp"
#include "offline/state_hash.hpp"
#include "rill/offline.hpp"
#include "support/gpu_test.hpp"

namespace rill::offline {
namespace {

class AdvancesTest : public test::GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    auto parsed = parseScene(R"({
      "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
      "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}]})",
                             "dam", ".");
    ASSERT_TRUE(parsed);
    scene = std::move(*parsed);
    restart();
  }
  void restart(bool mergePasses = false) {
    auto particles = makeParticles(scene);
    ASSERT_TRUE(particles);
    auto made = Fluid::create(device(), {.scene = &scene, .particles = &*particles, .mergePasses = mergePasses});
    ASSERT_TRUE(made) << made.error().message;
    fluid = std::move(*made);
    advances.emplace(context(), graph);
    advances->setFluid(*fluid, scene);
  }

  /// Advances to the `most`-th.
  void advance(uint64_t most, double budget_s) {
    while (advances->ended() < most || advances->inFlight() > 0) {
      ASSERT_TRUE(advances->submit({.advance_s = 1.0 / 60, .advances = most, .budget_s = budget_s}));
      ASSERT_TRUE(advances->finish(log));
    }
  }
  uint64_t hash() {
    Graph reading;
    const ReadoutTickets tickets = readout(reading, fluid->addTo(reading, {}));
    run(reading);
    const Readout read = collect(reading, tickets);
    return stateHash(read.positions, read.velocities, read.ids);
  }

  Scene scene;
  std::optional<Fluid> fluid;
  Graph graph;
  std::optional<Advances> advances;
  PassLog log;
};

TEST_F(AdvancesTest, DeviceHasAPieceInReserve) {
  constexpr uint64_t kAdvances = 8;
  for (const double budget : {0.0, 1e9}) {  // blocks; whole advances
    restart();
    uint64_t waits = 0;
    while (advances->ended() < kAdvances) {
      ASSERT_TRUE(advances->submit({.advance_s = 1.0 / 60, .advances = kAdvances, .budget_s = budget}));
      ASSERT_LE(advances->inFlight(), PieceQueue::kMaxInFlight);
      EXPECT_LE(advances->begun(), kAdvances);
      const bool expected = advances->ended() > 0 && advances->begun() < kAdvances;
      if (expected) { EXPECT_EQ(advances->inFlight(), PieceQueue::kMaxInFlight) << "the length of an advance is known"; }
      waits += advances->inFlight() < PieceQueue::kMaxInFlight;
      ASSERT_TRUE(advances->finish(log));
    }
    EXPECT_LE(waits, 12u) << "in the first advance and at the end";
  }
}

// Also where the density pass accounts for its substep itself, as on GPUs.
TEST_F(AdvancesTest, QueuedAdvancesKeepBits) {
  constexpr uint64_t kAdvances = 10;
  for (uint64_t k = 1; k <= kAdvances; ++k) advance(k, 1e9);
  const uint64_t one = hash();
  for (const bool mergePasses : {false, true})
    for (const double budget : {0.0, 0.001, 1e9}) {
      restart(mergePasses);
      advance(kAdvances, budget);
      EXPECT_EQ(hash(), one) << mergePasses << ", " << budget;
    }
}

TEST_F(AdvancesTest, NeverBeginsMoreAdvancesThanAskedFor) {
  for (uint64_t most = 1; most <= 6; ++most) {
    advance(most, 0.001);
    EXPECT_EQ(advances->ended(), most);
    EXPECT_NEAR(fluid->progress().time_s, double(most) / 60, 1e-6);
    EXPECT_EQ(fluid->progress().timeLeft_s, 0);
  }
}

// As after an error of a piece, with others in flight.
TEST_F(AdvancesTest, ContinuesAfterAbandonedPieces) {
  advance(2, 1e9);
  const Advances::Work work{.advance_s = 1.0 / 60, .advances = 3, .budget_s = 0.001};
  ASSERT_TRUE(advances->submit(work));
  ASSERT_GT(advances->inFlight(), 0u);
  advances->abandon();
  EXPECT_TRUE(advances->idle());
  EXPECT_EQ(advances->ended(), 2u);
  for (int pieces = 0; advances->ended() < 3 && pieces < 1000; ++pieces) {
    ASSERT_TRUE(advances->submit(work));
    ASSERT_GT(advances->inFlight(), 0u) << "nothing would ever end the advance";
    ASSERT_TRUE(advances->finish(log));
  }
  EXPECT_EQ(advances->ended(), 3u);
  EXPECT_EQ(fluid->progress().timeLeft_s, 0);
}

TEST_F(AdvancesTest, CountsEveryPassOnce) {
  advance(6, 0.001);
  const auto count = [&](std::string_view name) {
    for (const PassTime& pass : log.times())
      if (pass.name == name) return pass;
    return PassTime{};
  };
  EXPECT_GT(count("density").executed, 0u);
  EXPECT_LE(count("density").executed, count("density").recorded);
  EXPECT_EQ(count("density").executed, count("correct").executed);
}

TEST_F(AdvancesTest, WaitsWhereSolidsAreDriven) {
  scene.solids = {Solid{.shape = SphereShape{{0.8, 0.8, 0.15}, 0.05}, .driven = 1}};
  restart();
  while (advances->ended() < 4 || advances->inFlight() > 0) {
    ASSERT_TRUE(advances->submit({.advance_s = 1.0 / 60, .advances = 4, .budget_s = 1e9}));
    EXPECT_LE(advances->begun(), advances->ended() + 1);
    ASSERT_TRUE(advances->finish(log));
  }
  graph.reset();
  static_cast<void>(fluid->addTo(graph, {.advance_s = 1.0 / 60, .queued = true}));
  const auto compiled = graph.compile();
  ASSERT_FALSE(compiled);
  EXPECT_NE(compiled.error().message.find("FluidStep::queued"), std::string::npos) << compiled.error().message;
}

}  // namespace
}  // namespace rill::offline
