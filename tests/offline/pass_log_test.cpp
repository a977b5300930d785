#include "offline/pass_log.hpp"

#include <gtest/gtest.h>

namespace rill::offline {
namespace {

TEST(PassLog, SumsPiecesInOrder) {
  PassLog log;
  const PassReport report[] = {{"density", 4, false, ""}, {"vorticity", 0, true, "vorticity is 0"}};
  const Timing timings[] = {{"density", 2.0, 4}};
  for (int piece = 0; piece < 2; ++piece) {
    log.add(report, true);
    log.add(timings);
  }
  const auto times = log.times();
  ASSERT_EQ(times.size(), 1u);
  EXPECT_EQ(times[0].name, "density");
  EXPECT_EQ(times[0].recorded, 8u);
  EXPECT_DOUBLE_EQ(times[0].ms, 4.0);
  const auto skipped = log.skipped();
  ASSERT_EQ(skipped.size(), 1u);
  EXPECT_EQ(skipped[0].first, "vorticity");
  EXPECT_EQ(skipped[0].second, "vorticity is 0");
  EXPECT_NE(passTable(times, skipped).find("skipped: vorticity is 0"), std::string::npos);
}

TEST(PassLog, DistinguishesRecordedFromExecuted) {
  PassLog log;
  const PassReport report[] = {
      {"sort/count", 6, false, ""}, {"sort/scan", 12, false, ""}, {"density", 9, false, ""}, {"begin", 1, false, ""}};
  const FluidPassRuns skippable[] = {{"sort/", 2, 6}, {"density", 0, 9}, {"iterate", 1, 2}};
  log.add(report, true);
  log.add(skippable, report);
  const auto times = log.times();
  ASSERT_EQ(times.size(), 4u) << "passes that are not in the frame are ignored";
  EXPECT_EQ(times[0].executed, 2u);
  EXPECT_EQ(times[1].executed, 4u) << "two passes of this name per sort";
  EXPECT_EQ(times[1].recorded, 12u);
  EXPECT_EQ(times[2].executed, 0u);
  EXPECT_EQ(times[3].executed, 1u);
  const std::string table = passTable(times, {});
  EXPECT_NE(table.find("sort/scan                                   12         4"), std::string::npos) << table;
}

TEST(PassLog, ExecutedPassIsNotSkipped) {
  PassLog log;
  const PassReport without[] = {{"stats", 0, false, "not requested"}}, with[] = {{"stats", 1, false, ""}};
  log.add(without, true);
  EXPECT_EQ(log.skipped().size(), 1u);
  log.add(with, true);
  EXPECT_TRUE(log.skipped().empty());
  ASSERT_EQ(log.times().size(), 1u);
  log.clear();
  EXPECT_TRUE(log.times().empty());
}

TEST(PassLog, IgnoresUnsubmittedGraph) {
  PassLog log;
  const PassReport report[] = {{"density", 1, false, ""}};
  log.add(report, false);
  EXPECT_TRUE(log.times().empty());
}

}  // namespace
}  // namespace rill::offline
