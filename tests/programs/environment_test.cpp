// look.environment in rill-capture.
#include <gtest/gtest.h>

#include "rill/offline.hpp"
#include "support/child_process.hpp"
#include "support/picture.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace environment_test {

constexpr const char* kScene = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 0.6, 0.4], "open": ["-y"]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.4, 0.4]}}], "solids": [{"sphere": {"center": [0.8, 0.2, 0.2], "radius": 0.1}}],
  "camera": {"eye": [1.6, 0.8, 1.6], "target": [0.4, 0.2, 0.2]}, "look": {"environment": "skies/sky.hdr"}
})";

/// A Radiance image of 8 x 4 pixels of one color.
std::string radiance(const std::string& rgbe) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
  for (int k = 0; k < 32; ++k) text += rgbe;
  return text;
}

TEST(SceneEnvironment, FillsBackground) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  std::filesystem::create_directory(folder / "skies");
  folder.write("skies/sky.hdr", radiance({'\x80', '\x10', '\x10', '\x80'}));  // a dull red
  const Outcome with = capture({"scene.json", "--frames", "2", "--size", "96x54", "--out", "out"}, folder.string());
  ASSERT_EQ(with.code, 0) << with.err;
  const Outcome without =
      capture({"scene.json", "--frames", "2", "--size", "96x54", "--out", "plain", "--set", "look={}"}, folder.string());
  ASSERT_EQ(without.code, 0) << without.err;
  const Picture red = readPicture(folder / "out/frame_00001.png"), plain = readPicture(folder / "plain/frame_00001.png");
  ASSERT_EQ(red.rgb.size(), 3u * 96 * 54);
  const size_t corner = 0;
  EXPECT_GT(red.rgb[corner], 150);
  EXPECT_LT(red.rgb[corner + 1], 80);
  EXPECT_GT(plain.rgb[corner + 2], plain.rgb[corner]) << "the default sky is blue";
  EXPECT_GT(distance(red, plain).mean, 0.1);
}

TEST(SceneEnvironment, GroundLooksAsThatOfTheMap) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  std::filesystem::create_directory(folder / "skies");
  folder.write("skies/sky.hdr", radiance({'\x80', '\x40', '\x20', '\x80'}));  // orange all around
  for (const char* stage : {"grid", "tank"}) {
    const Outcome outcome = capture({"scene.json", "--frames", "1", "--size", "96x54", "--out", stage, "--set", "rill=0.2",
                                     "domain.open=[]", std::string("look.stage=") + stage},
                                    folder.string());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Picture picture = readPicture(folder / (std::string(stage) + "/frame_00000.png"));
    const size_t ground = 3u * 96 * 53;  // lower left, the sky is upper left
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(picture.rgb[ground + c], picture.rgb[c], 4) << stage;
  }
}

TEST(SceneSky, IsDrawnUnlessThereIsAnEnvironment) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  std::filesystem::create_directory(folder / "skies");
  folder.write("skies/sky.hdr", radiance({'\x80', '\x10', '\x10', '\x80'}));
  const auto drawn = [&](const std::vector<std::string>& set) {
    std::vector<std::string> arguments{"scene.json", "--frames", "1", "--size", "96x54", "--out", "out", "--set", "rill=0.2"};
    arguments.insert(arguments.end(), set.begin(), set.end());
    const Outcome outcome = capture(arguments, folder.string());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return readPicture(folder / "out/frame_00000.png");
  };
  const Picture studio = drawn({"look={}"}), day = drawn({"look={\"sky\": \"day\"}"}), sunset = drawn({"look={\"sky\": \"sunset\"}"});
  EXPECT_GT(distance(studio, day).mean, 0.05);
  EXPECT_GT(distance(day, sunset).mean, 0.01);
  EXPECT_EQ(drawn({"look={\"sky\": \"studio\"}"}).rgb, studio.rgb);
  EXPECT_EQ(drawn({"look.sky=day"}).rgb, drawn({}).rgb) << "the environment is drawn";
}

TEST(SceneEnvironment, RejectsBadFilesWithName) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const auto errorOf = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"scene.json", "--frames", "1", "--size", "64x36", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = capture(arguments, folder.string());
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << "nothing is written";
    return outcome.err;
  };
  EXPECT_NE(errorOf().find("scene.json: look.environment: \"skies/sky.hdr\": no such file"), std::string::npos) << errorOf();
  std::filesystem::create_directory(folder / "skies");
  EXPECT_NE(errorOf({"--set", "look.environment=skies"}).find("not a regular file; expected a file"), std::string::npos);
  EXPECT_NE(errorOf({"--set", "look.environment="}).find("expected a file name"), std::string::npos);
  folder.write("skies/sky.hdr", "no picture at all");
  const std::string text = errorOf();
  EXPECT_NE(text.find("scene.json: look.environment: "), std::string::npos) << text;
  EXPECT_NE(text.find("sky.hdr: not an image; expected a .hdr, .png or .jpg file"), std::string::npos) << text;
  folder.write("skies/sky.hdr", radiance("abcd").substr(0, 100));
  EXPECT_NE(errorOf().find("sky.hdr: the image data is truncated"), std::string::npos);
  folder.write("square.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\nabcdabcdabcdabcd");
  EXPECT_NE(errorOf({"--set", "look.environment=square.hdr"}).find("found 2x2 pixels; expected twice as wide as high"), std::string::npos);
  // Without images the environment is not read.
  EXPECT_EQ(capture({"scene.json", "--frames", "1", "--no-images", "--quiet"}, folder.string()).code, 0);
}

// With the validation layer: with and without solids, several frames.
TEST(SceneEnvironment, RendersCleanUnderValidation) {
  const TemporaryFolder folder;
  for (const bool solids : {true, false}) {
    Scene scene;
    scene.fluid.spacing = 0.1;
    scene.domain = Domain{{0, 0, 0}, {1, 1, 1}, 0};
    scene.fill.push_back(Fill{.shape = BoxShape{{0, 0, 0}, {0.5, 0.5, 1}}});
    if (solids) scene.solids.push_back(Solid{.shape = SphereShape{{0.8, 0.2, 0.5}, 0.1}});
    scene.look.environment = folder.write("sky.hdr", radiance({'\x80', '\x40', '\x20', '\x81'}));
    offline::Options options;
    options.validation = true;
    auto run = offline::Simulation::open(scene, options);
    ASSERT_TRUE(run) << run.error().message;
    for (int frame = 0; frame < 3; ++frame) {
      ASSERT_TRUE(run->advance(0.02));
      const auto image = run->render("final", 160, 90);
      ASSERT_TRUE(image) << image.error().message;
    }
    for (const std::string& text : run->takeValidationMessages()) ADD_FAILURE() << text;
  }
}

}  // namespace environment_test
}  // namespace rill::test
