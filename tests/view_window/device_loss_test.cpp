// A device that is lost, or exchanged, while the viewer runs.
#include <algorithm>

#include "support/two_devices.hpp"
#include "view_window/view_window.hpp"

namespace rill::test {
namespace {

TEST_F(ViewWindowTest, ContinuesOnANewDevice) {
  for (const char* plan : {"vkQueueSubmit2 9 -4", "vkWaitSemaphores 6 -4", "vkAcquireNextImageKHR 3 -4", "vkQueuePresentKHR 3 -4"}) {
    const Outcome outcome = viewFailing(plan, {scene, "--frames", "12", "--size", "320x200", "--view", "particles", "--validate"});
    EXPECT_EQ(outcome.code, 0) << plan << ": " << outcome.err;
    EXPECT_EQ(figure(outcome, "frames"), "12");
    EXPECT_NE(outcome.err.find("lost"), std::string::npos) << plan << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("The simulation continues on"), std::string::npos) << plan << ": " << outcome.err;
  }
}

// A change of the scene leaves a snapshot; from there on the bits are those of a run that lost nothing.
TEST_F(ViewWindowTest, ContinuesFromTheLastSnapshotBitwise) {
  folder.write("hands.txt", "8 set fluid.viscosity=0.1\n24 view particles\n");
  const std::vector<std::string> arguments{scene, "--script", "hands.txt", "--size", "320x200"};
  const Outcome lost = viewFailing("vkQueuePresentKHR 16 -4", arguments);
  ASSERT_EQ(lost.code, 0) << lost.err;
  EXPECT_NE(lost.err.find("from 0.1167 s"), std::string::npos) << "frame 8 shows step 8, of which 7 were finished before: " << lost.err;
  const int steps = std::stoi("0" + figure(lost, "steps"));
  ASSERT_EQ(steps, 7 + 24 - 15) << "as many as there were frames after the loss";
  folder.write("hands.txt", "8 set fluid.viscosity=0.1\n" + std::to_string(steps) + " view particles\n");
  const Outcome kept = view(arguments);
  ASSERT_EQ(figure(kept, "steps"), std::to_string(steps)) << kept.err;
  EXPECT_EQ(figure(lost, "state_hash"), figure(kept, "state_hash"));
}

TEST_F(ViewWindowTest, GivesUpOnADeviceThatIsLostAgain) {
  const Outcome again = viewFailing("vkQueueSubmit2 9 -4; vkQueueSubmit2 40 -4", {scene, "--frames", "60"});
  EXPECT_EQ(again.code, 1);
  EXPECT_NE(again.err.find("lost a moment before"), std::string::npos) << again.err;
  const Outcome always = viewFailing("vkQueuePresentKHR * -4", {scene, "--frames", "30"});
  EXPECT_EQ(always.code, 1);
}

TEST_F(ViewWindowTest, ChangesTheDeviceBitwise) {
  const Child::Environment two = twoDevices(folder);
  ASSERT_FALSE(two.empty());
  const Outcome list = Child({program(), "--list-devices"}, folder.string(), two).wait();
  EXPECT_EQ(list.code, 0) << list.err;
  EXPECT_EQ(std::ranges::count(list.out, '\n'), 3) << list.out;
  // The list below "present", and its second row.
  folder.write("hands.txt",
               "2 move 97 201\n2 press left\n3 release left\n8 move 97 246\n9 press left\n10 release left\n20 view particles\n");
  const std::vector<std::string> arguments{scene, "--view", "particles", "--script", "hands.txt", "--screenshot", "end.png", "--validate"};
  const Outcome changed = Child(command(arguments), folder.string(), two).wait(), same = view(arguments);
  ASSERT_EQ(changed.code, 0) << changed.err;
  EXPECT_EQ(changed.err, "");
  EXPECT_EQ(figure(changed, "steps"), "20");
  EXPECT_EQ(figure(changed, "state_hash"), figure(same, "state_hash"));
  // That the device has changed: its window gets a second swapchain.
  Child::Environment failing{{"VK_ADD_LAYER_PATH", RILL_LAYERS_FOLDER},
                             {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"},
                             {"RILL_TEST_FAIL", "vkCreateSwapchainKHR 2 -3"}};
  EXPECT_EQ(Child(command(arguments), folder.string(), failing).wait().code, 0);
  failing.insert(failing.end(), two.begin(), two.end());
  EXPECT_EQ(Child(command(arguments), folder.string(), failing).wait().code, 1);
}

TEST_F(ViewWindowTest, ListsDevicesThatCannotPresent) {
  const Outcome able = viewFailing("", {"--list-devices"});
  EXPECT_EQ(able.code, 0) << able.err;
  EXPECT_EQ(able.out.find("cannot be used"), std::string::npos) << able.out;
  const Child::Environment environment{
      {"VK_ADD_LAYER_PATH", RILL_LAYERS_FOLDER}, {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"}, {"RILL_TEST_PRESENTS", "0"}};
  const Outcome unable = Child(command({"--list-devices"}), folder.string(), environment).wait();
  EXPECT_EQ(unable.code, 0) << unable.err;
  EXPECT_NE(unable.out.find("presentation to this display"), std::string::npos) << unable.out;
}

TEST_F(ViewWindowTest, ReportsUnknownPresentModes) {
  for (const char* call : {"1", "2"}) {
    const Outcome outcome = viewFailing("vkGetPhysicalDeviceSurfacePresentModesKHR " + std::string(call) + " -1",
                                        {scene, "--frames", "2", "--present", "immediate"});
    EXPECT_NE(outcome.code, 0);
    EXPECT_NE(outcome.err.find("present modes"), std::string::npos) << outcome.err;
  }
}

TEST_F(ViewWindowTest, ReportsExhaustedMemory) {
  const Outcome full = viewFailing("vkAllocateMemory 30 -2", {scene, "--frames", "30"});
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.err.find("memory"), std::string::npos) << full.err;
}

}  // namespace
}  // namespace rill::test
