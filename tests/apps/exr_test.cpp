#include "shared/exr.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

#ifdef RILL_OPENEXR
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#endif

namespace rill::test {
namespace exr_test {

constexpr const char* kScene = R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 1]}}]})";

/// Half floats in the order of the image: 1, 65504, the smallest, and a ramp.
offline::LinearImage ramp() {
  offline::LinearImage image{5, 3, {0x3C00, 0x7BFF, 0x0001, 0x3C00}};
  while (image.rgba.size() < 60) image.rgba.push_back(uint16_t(0x2000 + 37 * image.rgba.size()));
  return image;
}

#ifdef RILL_OPENEXR
TEST(Exr, RoundTripsHalves) {
  const TemporaryFolder folder;
  const offline::LinearImage image = ramp();
  const auto written = apps::writeExr(folder / "a.exr", image);
  ASSERT_TRUE(written) << written.error().message;
  Imf::InputFile file((folder / "a.exr").c_str());
  const auto& window = file.header().dataWindow();
  ASSERT_EQ(window.max.x - window.min.x + 1, 5);
  ASSERT_EQ(window.max.y - window.min.y + 1, 3);
  size_t channels = 0;
  for (auto at = file.header().channels().begin(); at != file.header().channels().end(); ++at, ++channels)
    EXPECT_EQ(at.channel().type, Imf::HALF) << at.name();
  EXPECT_EQ(channels, 3u);
  for (size_t c = 0; c < 3; ++c) {
    std::vector<uint16_t> values(15);
    Imf::FrameBuffer frame;
    const char name[] = {"RGB"[c], '\0'};
    frame.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), 2, 10));
    file.setFrameBuffer(frame);
    file.readPixels(0, 2);
    for (size_t i = 0; i < 15; ++i) EXPECT_EQ(values[i], image.rgba[4 * i + c]) << "pixel " << i << ", channel " << c;
  }
}

TEST(Exr, FailsWholeWithTheNameOfTheFile) {
  const TemporaryFolder folder;
  for (const std::filesystem::path& file : {std::filesystem::path("/dev/full"), folder / "none/a.exr"}) {
    const auto written = apps::writeExr(file, ramp());
    ASSERT_FALSE(written) << file;
    EXPECT_EQ(written.error().kind, ErrorKind::Io);
    EXPECT_NE(written.error().message.find(file.string()), std::string::npos) << written.error().message;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_FALSE(apps::writeExr(folder / "a.exr", {4, 4, {}}));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}
#else
TEST(Exr, IsRefusedWithoutOpenExr) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const Outcome outcome = capture({"scene.json", "--exr"}, folder.string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("built without OpenEXR"), std::string::npos) << outcome.err;
  EXPECT_FALSE(apps::writeExr(folder / "a.exr", ramp()));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
}
#endif

TEST(Exr, OptionIsRefusedWithoutLinearImages) {
  ASSERT_TRUE(apps::writesExr()) << "built without OpenEXR: is it installed? (apps/setup.sh)";
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  for (const auto& [arguments, word] :
       {std::pair{std::vector<std::string>{"--view", "depth"}, "--exr: the view depth is not linear light; expected --view final"},
        std::pair{std::vector<std::string>{"--no-images"}, "--exr: not possible with --no-images"}}) {
    std::vector<std::string> all{"scene.json", "--exr"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = capture(all, folder.string());
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

}  // namespace exr_test
}  // namespace rill::test
