// rill-capture --exr.
#include "shared/exr.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace exr_test {

constexpr const char* kScene = R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 1]}}]})";

TEST(Exr, ProgramWritesLinearImagesInPlaceOfPng) {
  ASSERT_TRUE(apps::writesExr()) << "built without OpenEXR: is it installed? (apps/setup.sh)";
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const auto drawn = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"scene.json", "--frames", "2", "--size", "48x27", "--out", "out", "--exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = capture(arguments, folder.string());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("frame_00000.exr to frame_00001.exr"), std::string::npos) << outcome.err;
    return contentOf(folder / "out/frame_00001.exr");
  };
  const std::string plain = drawn({});
  EXPECT_EQ(plain.substr(0, 4), "\x76\x2f\x31\x01");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frame_00001.png"));
  EXPECT_EQ(drawn({"--exposure", "3"}), plain) << "before exposure";
  // Another capture removes them.
  EXPECT_EQ(capture({"scene.json", "--frames", "1", "--size", "48x27", "--out", "out", "--quiet"}, folder.string()).code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frame_00001.exr"));
}
TEST(Exr, PlaybackWritesThemToo) {
  ASSERT_TRUE(apps::writesExr()) << "built without OpenEXR: is it installed? (apps/setup.sh)";
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const std::vector<std::string> common{"scene.json", "--size", "48x27", "--exr", "--quiet"};
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = capture(arguments, folder.string());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  };
  run({"--frames", "1", "--export", "ply", "--out", "out"});
  run({"--play", "out", "--out", "again"});
  const std::string again = contentOf(folder / "again/frame_00000.exr");
  EXPECT_EQ(again.substr(0, 4), "\x76\x2f\x31\x01");
  EXPECT_FALSE(std::filesystem::exists(folder / "again/frame_00000.png"));
}

}  // namespace exr_test
}  // namespace rill::test
