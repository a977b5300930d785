#include "offline/pacing.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rill::offline {
namespace {

constexpr uint32_t kBlock = 6;

/// A step of `substeps` on a machine that takes `cost` a substep; the seconds of its longest piece, and how many there were.
struct Course {
  double longest = 0;
  int pieces = 0;
};
Course stepOf(Pacing& pacing, uint32_t substeps, double cost, double budget) {
  Course run;
  for (uint32_t left = substeps; left > 0;) {
    const uint32_t recorded = pacing.next(budget), due = std::min(recorded, left);
    EXPECT_EQ(recorded % kBlock, 0u);
    EXPECT_GT(recorded, 0u);
    pacing.submit(recorded);
    pacing.addPiece(recorded, due, due * cost);
    left -= due;
    run.longest = std::max(run.longest, due * cost);
    ++run.pieces;
  }
  pacing.endStep(substeps);
  return run;
}

TEST(Pacing, PiecesStayWithinBudget) {
  Pacing pacing(kBlock);
  for (int k = 0; k < 10; ++k) {
    const Course run = stepOf(pacing, 40, 0.005, 0.05);  // 0.2 s a step
    EXPECT_LE(run.longest, 0.05 + 1e-9);
    EXPECT_GE(run.pieces, 5);
  }
  EXPECT_NEAR(pacing.cost(), 0.005, 1e-9);
}

TEST(Pacing, MinimumIsOneBlock) {
  Pacing pacing(kBlock);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(stepOf(pacing, 12, 0.1, 0.01).longest, 0.6, 1e-9);
}

TEST(Pacing, FastMachineNeedsOnePiecePerStep) {
  Pacing pacing(kBlock);
  stepOf(pacing, 20, 1e-5, 0.05);
  EXPECT_EQ(pacing.next(0.05), 24u);
  EXPECT_EQ(stepOf(pacing, 20, 1e-5, 0.05).pieces, 1);
  // One that needs more than the one before is endStep all the same.
  EXPECT_EQ(stepOf(pacing, 30, 1e-5, 0.05).pieces, 2);
}

TEST(Pacing, PiecesOfFirstStepDouble) {
  Pacing pacing(kBlock);
  for (const uint32_t piece : {kBlock, 2 * kBlock, 4 * kBlock, 8 * kBlock}) {
    EXPECT_EQ(pacing.next(std::numeric_limits<double>::infinity()), piece);
    pacing.submit(piece);
    pacing.addPiece(piece, piece, 0.001 * piece);
  }
}

TEST(Pacing, BlockSizeMayChange) {
  Pacing pacing(kBlock);
  stepOf(pacing, 18, 1e-5, 0.05);
  pacing.setBlock(4);
  EXPECT_EQ(pacing.next(0.05), 20u);
}

TEST(Pacing, UnboundedBudgetIsOneExpectedStep) {
  Pacing pacing(kBlock);
  stepOf(pacing, 18, 0.01, std::numeric_limits<double>::infinity());
  EXPECT_EQ(pacing.next(std::numeric_limits<double>::infinity()), 18u);
}

TEST(Pacing, AdaptsToSlowerMachine) {
  Pacing pacing(kBlock);
  for (int k = 0; k < 5; ++k) stepOf(pacing, 48, 0.001, 0.02);
  for (int k = 0; k < 3; ++k) stepOf(pacing, 48, 0.01, 0.02);
  EXPECT_LE(stepOf(pacing, 48, 0.01, 0.07).longest, 0.07);
}

TEST(Pacing, PiecesInFlightCoverTheExpectedRest) {
  Pacing pacing(kBlock);
  stepOf(pacing, 24, 0.001, 1);
  pacing.submit(pacing.next(0.012));
  EXPECT_EQ(pacing.next(0.012), 12u) << "while the first is in flight";
  pacing.submit(12);
  EXPECT_EQ(pacing.next(0.012), 0u) << "24 were expected";
  EXPECT_EQ(pacing.first(0.012), 12u) << "of the next advance";
  pacing.submit(12, true);
  pacing.addPiece(12, 12, 0.012);
  pacing.addPiece(12, 12, 0.012);
  pacing.endStep(24);
  EXPECT_EQ(pacing.next(0.1), 12u) << "the other half";
}

TEST(Pacing, PieceAheadMayServeALongerAdvance) {
  Pacing pacing(kBlock);
  stepOf(pacing, 12, 0.001, 1);
  pacing.submit(12);
  pacing.submit(12, true);
  pacing.addPiece(12, 12, 0.012);
  pacing.addPiece(12, 6, 0.006, true);  // this advance took it
  pacing.endStep(18);
  EXPECT_EQ(pacing.next(1), 18u) << "nothing of the next advance has run";
}

TEST(Pacing, AbandonedPiecesDoNotCount) {
  Pacing pacing(kBlock);
  stepOf(pacing, 24, 0.001, 1);
  pacing.submit(12);
  pacing.submit(12);
  pacing.submit(24, true);
  pacing.abandon();
  EXPECT_EQ(pacing.next(1), 24u) << "the whole advance again";
  EXPECT_EQ(stepOf(pacing, 24, 0.001, 1).pieces, 1);
  EXPECT_EQ(pacing.next(1), 24u);
}

}  // namespace
}  // namespace rill::offline
