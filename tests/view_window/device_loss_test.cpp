// A device that is lost while the viewer runs.
#include "view_window/view_window.hpp"

namespace rill::test {
namespace {

TEST_F(ViewWindowTest, ReportsALostDevice) {
  for (const char* plan : {"vkQueueSubmit2 9 -4", "vkWaitSemaphores 6 -4", "vkAcquireNextImageKHR 3 -4", "vkQueuePresentKHR 3 -4"}) {
    const Outcome outcome = viewFailing(plan, {scene, "--frames", "30"});
    EXPECT_EQ(outcome.code, 1) << plan;
    EXPECT_NE(outcome.err.find("lost"), std::string::npos) << plan << ": " << outcome.err;
  }
  const Outcome full = viewFailing("vkAllocateMemory 30 -2", {scene, "--frames", "30"});
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.err.find("memory"), std::string::npos) << full.err;
}

}  // namespace
}  // namespace rill::test
