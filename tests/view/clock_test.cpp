#include "view/clock.hpp"

#include <gtest/gtest.h>

namespace rill::view {
namespace {

/// Displayed frames of `frame_s` for `seconds`; a machine that simulates `most` steps a frame at most. The steps that began.
int stepsIn(Clock& clock, double seconds, double frame_s, int most) {
  int steps = 0;
  for (double t = 0; t < seconds - 1e-9; t += frame_s) {
    clock.addRealTime(frame_s);
    for (int k = 0; k < most && clock.due(); ++k) {
      clock.beginSteps(1);
      clock.endStep();
      ++steps;
    }
  }
  return steps;
}

TEST(Clock, FollowsRealTimeAtAnyFrameRate) {
  for (const double rate : {24.0, 59.94, 60.0, 75.0, 144.0}) {
    Clock clock;
    EXPECT_NEAR(stepsIn(clock, 5, 1 / rate, 10), 300, 2) << rate;
    EXPECT_NEAR(clock.speed(), 1, 0.03) << rate;
    EXPECT_FALSE(clock.slow()) << rate;
  }
}

TEST(Clock, ReportsSlownessAndDoesNotCatchUp) {
  Clock clock;
  EXPECT_EQ(stepsIn(clock, 5, 1.0 / 24, 1), 120) << "a step a frame is all it can do";
  EXPECT_NEAR(clock.speed(), 0.4, 0.03);
  EXPECT_TRUE(clock.slow());
  // Quick again: no burst of what was missed.
  EXPECT_LE(stepsIn(clock, 0.5, 1.0 / 60, 10), 30 + 6);
}

TEST(Clock, LongFrameIsNotCaughtUp) {
  Clock clock;
  clock.addRealTime(30);
  int steps = 0;
  for (; clock.due(); ++steps) clock.beginSteps(1);
  EXPECT_LE(steps, 6) << "a tenth of a second";
}

TEST(Clock, SpeedIsOneUntilMeasured) {
  Clock clock;
  EXPECT_FALSE(clock.due());
  EXPECT_EQ(clock.speed(), 1);
  clock.addRealTime(0.1);
  EXPECT_EQ(clock.speed(), 1) << "too early to tell";
  clock.restart();
  EXPECT_FALSE(clock.due());
}

}  // namespace
}  // namespace rill::view
