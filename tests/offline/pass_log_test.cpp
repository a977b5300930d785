#include "offline/pass_log.hpp"

#include <gtest/gtest.h>

namespace rill::offline {
namespace {

TEST(PassLog, AddsUpPiecesAndKeepsTheOrder) {
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
  EXPECT_EQ(times[0].runs, 8u);
  EXPECT_DOUBLE_EQ(times[0].ms, 4.0);
  const auto skipped = log.skipped();
  ASSERT_EQ(skipped.size(), 1u);
  EXPECT_EQ(skipped[0].first, "vorticity");
  EXPECT_EQ(skipped[0].second, "vorticity is 0");
  EXPECT_NE(passTable(times, skipped, 3, 1).find("skipped: vorticity is 0"), std::string::npos);
}

TEST(PassLog, APassThatRanOnceIsNotSkipped) {
  PassLog log;
  const PassReport without[] = {{"stats", 0, false, "nobody asked"}}, with[] = {{"stats", 1, false, ""}};
  log.add(without, true);
  EXPECT_EQ(log.skipped().size(), 1u);
  log.add(with, true);
  EXPECT_TRUE(log.skipped().empty());
  ASSERT_EQ(log.times().size(), 1u);
  log.clear();
  EXPECT_TRUE(log.times().empty());
}

TEST(PassLog, AGraphThatWasNotSubmittedRanNothing) {
  PassLog log;
  const PassReport report[] = {{"density", 1, false, ""}};
  log.add(report, false);
  EXPECT_TRUE(log.times().empty());
}

}  // namespace
}  // namespace rill::offline
