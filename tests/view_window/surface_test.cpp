// What the window's surface offers: formats, present modes, and when its swapchain is made again.
#include <cstring>

#include "support/picture.hpp"
#include "view_window/view_window.hpp"

namespace rill::test {
namespace {

/// The screen of an Xvfb, from the file in XWD format that it keeps in a folder (-fbdir).
Picture readScreen(const std::filesystem::path& file) {
  const std::string bytes = contentOf(file);
  const auto word = [&](size_t at) {
    uint32_t value = 0;
    if (at + 4 <= bytes.size()) std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  const auto header = [&](size_t k) { return __builtin_bswap32(word(4 * k)); };  // big-endian, unlike the pixels
  constexpr size_t kColorBytes = 12;
  const uint32_t headerBytes = header(0), width = header(4), height = header(5), rowBytes = header(12), colors = header(19);
  const size_t first = headerBytes + kColorBytes * colors;
  if (bytes.size() < first + size_t{rowBytes} * height) return {};
  Picture screen{width, height, {}};
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      for (const uint32_t mask : {header(14), header(15), header(16)}) {
        const int shift = __builtin_ctz(mask);
        const uint32_t most = mask >> shift, value = (word(first + size_t{rowBytes} * y + 4 * x) & mask) >> shift;
        screen.rgb.push_back(static_cast<uint8_t>((value * 255 + most / 2) / most));
      }
  return screen;
}

struct Surface {
  const char* name;
  int format;  ///< VkFormat
};
void PrintTo(const Surface& surface, std::ostream* out) { *out << surface.name; }

class SurfaceFormatTest : public ViewWindowTest, public ::testing::WithParamInterface<Surface> {};

// The screen shows what a screenshot contains: an SRGB format that is written like a UNORM one would be too bright.
TEST_P(SurfaceFormatTest, ScreenShowsTheScreenshot) {
  folder.write("hold.txt", "0 key P\n0 key Tab\n4 screenshot shown.png\n1000000 view final\n");
  std::vector<std::string> command = onADisplay("1280x720x24", " -fbdir " + folder.string());
  const std::string view = "echo $$ > pid; exec '" + program() + "' '" + scene + "' --script hold.txt --validate";
  command.insert(command.end(), {"/bin/sh", "-c", view});
  const Child::Environment environment{{"VK_ADD_LAYER_PATH", RILL_LAYERS_FOLDER},
                                       {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"},
                                       {"RILL_TEST_SURFACE_FORMAT", std::to_string(GetParam().format)}};
  Child child(command, folder.string(), environment);
  ASSERT_TRUE(child.waitForFile(folder / "shown.png")) << child.wait().err;
  const Picture shot = readPicture(folder / "shown.png");
  ASSERT_EQ(shot.width, 1280u);
  size_t different = shot.rgb.size();
  // Presenting takes a while; a notice about the screenshot hides a part of the picture then.
  for (int tries = 0; tries < 500 && 20 * different > shot.rgb.size(); ++tries) {
    ::usleep(20'000);
    const Picture screen = readScreen(folder / "Xvfb_screen0");
    ASSERT_EQ(screen.rgb.size(), shot.rgb.size());
    different = 0;
    for (size_t k = 0; k < shot.rgb.size(); ++k) different += std::abs(int{shot.rgb[k]} - int{screen.rgb[k]}) > 1;
  }
  EXPECT_LT(20 * different, shot.rgb.size());
  ::kill(std::stoi(contentOf(folder / "pid")), SIGTERM);
  const Outcome outcome = child.wait();
  EXPECT_EQ(outcome.err, "");
}

INSTANTIATE_TEST_SUITE_P(Formats, SurfaceFormatTest, ::testing::Values(Surface{"Unorm", 44}, Surface{"Srgb", 50}),
                         [](const auto& surface) { return surface.param.name; });

// Lavapipe shows nothing on a screen of this depth. What is written to the format: tests/view_runner/window_pass_test.cpp.
TEST_F(ViewWindowTest, RunsOnTenBitSurfaces) {
  std::vector<std::string> command = onADisplay("1280x720x30");
  command.insert(command.end(), {program(), scene, "--frames", "4", "--screenshot", "end.png", "--validate"});
  const Child::Environment environment{
      {"VK_ADD_LAYER_PATH", RILL_LAYERS_FOLDER}, {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"}, {"RILL_TEST_SURFACE_FORMAT", "58"}};
  const Outcome outcome = Child(command, folder.string(), environment).wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(sizeOf("end.png"), std::pair(1280, 720));
}

TEST_F(ViewWindowTest, RejectsSurfacesOfOtherFormats) {
  const Child::Environment environment{
      {"VK_ADD_LAYER_PATH", RILL_LAYERS_FOLDER}, {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"}, {"RILL_TEST_SURFACE_FORMAT", "-1"}};
  const Outcome outcome = Child(command({scene, "--frames", "1"}), folder.string(), environment).wait();
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.err.find("expected 8-bit UNORM"), std::string::npos) << outcome.err;
}

TEST_F(ViewWindowTest, PresentsInEveryMode) {
  for (const char* mode : {"fifo", "mailbox", "immediate", "fifo-relaxed"}) {
    const Outcome outcome = view({scene, "--frames", "5", "--present", mode, "--validate"});
    EXPECT_EQ(outcome.code, 0) << mode << ": " << outcome.err;
    EXPECT_EQ(outcome.err, "") << mode;
  }
}

TEST_F(ViewWindowTest, RecoversFromOutOfDateSwapchains) {
  for (const char* plan : {"vkAcquireNextImageKHR 3 -1000001004", "vkQueuePresentKHR 3 -1000001004"}) {
    const Outcome outcome = viewFailing(plan, {scene, "--frames", "8"});
    EXPECT_EQ(outcome.code, 0) << plan << ": " << outcome.err;
    EXPECT_EQ(figure(outcome, "frames"), "8");
  }
}

TEST_F(ViewWindowTest, KeepsSuboptimalSwapchains) {
  for (const char* suboptimal : {"vkQueuePresentKHR * 1000001003", "vkAcquireNextImageKHR * 1000001003"}) {
    const Outcome outcome = viewFailing(suboptimal + std::string("; vkCreateSwapchainKHR 2 -3"), {scene, "--frames", "12"});
    EXPECT_EQ(outcome.code, 0) << suboptimal << ": a second swapchain was made: " << outcome.err;
    EXPECT_EQ(figure(outcome, "frames"), "12");
  }
  folder.write("resize.txt", "3 resize 640 360\n9 screenshot end.png\n");
  const Outcome resized = viewFailing("vkQueuePresentKHR * 1000001003", {scene, "--script", "resize.txt"});
  EXPECT_EQ(resized.code, 0) << resized.err;
  EXPECT_EQ(sizeOf("end.png"), std::pair(640, 360)) << "a new size is noticed";
}

}  // namespace
}  // namespace rill::test
