// What rill-capture says to bad input: all of it is judged before a device is opened, so nothing here needs Vulkan.
#include <gtest/gtest.h>

#include <algorithm>

#include "capture/options.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

constexpr const char* kScene = R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"min": [0,0,0], "max": [1,1,1]},
  "fill": [{"box": {"min": [0,0,0], "max": [0.5,0.5,0.5]}}], "probes": [{"name": "H1", "level": [0.2, 0.2]}]})";

/// Bad input: exit code 2, `words` in the message, nothing on standard output, nothing left in the folder.
void expectRefused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const Outcome outcome = capture(arguments, folder.string());
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("rill-capture: ")) << outcome.err;
  for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " is not in: " << outcome.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.json"}) << "nothing is written";
}

TEST(CommandLine, HelpTeaches) {
  for (const char* option : {"--help", "-h"}) {
    const Outcome outcome = capture({option});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    for (const char* word : {"SCENE",
                             "--frames",
                             "--fps",
                             "--size",
                             "--out",
                             "--view",
                             "--stats",
                             "--export",
                             "--particles",
                             "--set",
                             "--device",
                             "--require",
                             "--explain",
                             "--no-images",
                             "--quiet",
                             "--help",
                             "--version",
                             "--no-pass-times",
                             "--checkpoint",
                             "--checkpoint-every",
                             "--resume",
                             "--play",
                             "--orbit",
                             "--video",
                             "Examples:",
                             "Exit codes:",
                             "final, particles, density"})
      EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  }
}

TEST(CommandLine, VersionIsOneLine) {
  const Outcome outcome = capture({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("rill-capture ")) << outcome.out;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
}

TEST(CommandLine, HelpIntoAClosedPipeOrAFullDiskFails) {
  const Outcome full = capture({"--help"}, ".", {}, "/dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.err.find("No space left"), std::string::npos) << full.err;
}

TEST(CommandLine, NamesTheOptionAndWhatWasExpected) {
  expectRefused({}, {"SCENE"});
  expectRefused({"scene.json", "--frmes", "3"}, {"\"--frmes\"", "did you mean \"--frames\"?", "--help"});
  expectRefused({"scene.json", "--frames"}, {"--frames"});
  for (const char* bad : {"0", "-1", "3.5", "x", "", "99999999999999999999"})
    expectRefused({"scene.json", "--frames", bad}, {"--frames", "expected a whole number from 1"});
  for (const char* bad : {"0", "-60", "nan", "inf", "60x"}) expectRefused({"scene.json", "--fps", bad}, {"--fps", "expected a number"});
  for (const char* bad : {"640", "640x", "x480", "640x480x2", "0x480", "640*480", "9000x10", "8192x8192"})
    expectRefused({"scene.json", "--size", bad}, {"--size", "as 1280x720"});
  expectRefused({"scene.json", "--export", "obj"}, {"--export", "expected ply"});
  for (const char* bad : {"0", "-5", "1e4", "many"})
    expectRefused({"scene.json", "--particles", bad}, {"--particles", "expected a whole number"});
  expectRefused({"scene.json", "--set", "fluid.viscosity"}, {"--set", "fluid.viscosity"});
  for (const char* bad : {"-1", "soon", "", "nan"})
    expectRefused({"scene.json", "--checkpoint", "run.rill", "--checkpoint-every", bad}, {"--checkpoint-every", "a number of seconds"});
  expectRefused({"scene.json", "--checkpoint-every", "60"}, {"--checkpoint-every", "expected --checkpoint FILE"});
  expectRefused({"scene.json", "--checkpoint", ""}, {"--checkpoint", "expected the name of a file"});
  expectRefused({"scene.json", "--checkpoint", "-"}, {"--checkpoint", "expected the name of a file"});
  expectRefused({"scene.json", "--checkpoint", "./a", "--stats", "a"}, {"--checkpoint", "another file than that of --stats"});
  for (const char* bad : {"", "film", "film.avi", ".mp4", "-", "film.MP4"})
    expectRefused({"scene.json", "--video", bad}, {"--video", "ends in .mp4, .mkv or .mov"});
  expectRefused({"scene.json", "--video", "./a.mp4", "--stats", "a.mp4"}, {"--video", "another file than that of --stats"});
  expectRefused({"scene.json", "--video", "./a.mp4", "--checkpoint", "a.mp4"}, {"--video", "another file than that of --checkpoint"});
  expectRefused({"scene.json", "--resume", ""}, {"--resume", "a file that --checkpoint wrote"});
  expectRefused({"scene.json", "other.json"}, {"\"other.json\"", "one argument too many"});
  expectRefused({"scene.json", "--frames", "2", "--frames", "3"}, {"--frames"});
}

TEST(CommandLine, UnknownNamesGetTheList) {
  expectRefused({"scene.json", "--size", "8192x4096"}, {"--size, --view final", "8192x4096", "16777216"});
  expectRefused({"scene.json", "--view", "particels"},
                {"\"particels\"", "did you mean \"particles\"?", "views: final, particles, density, speed, depth, normals, thickness"});
  expectRefused({"dam-brake"}, {"\"dam-brake\"", "did you mean \"dam-break\"?", "resting-column", "validation/martin-moyce-1"});
  expectRefused({"scene.json", "--require", "outsid<1"}, {"\"outsid\"", "did you mean \"outside\"?", "density_error_p99", "probes.H1"});
}

TEST(CommandLine, RequirementsAreReadBeforeAnythingRuns) {
  for (const char* bad : {"outside", "outside=1", "<1", "outside<one"})
    expectRefused({"scene.json", "--require", bad}, {"--require", "expected FIGURE<NUMBER"});
}

TEST(CommandLine, ScenesAreJudgedBeforeADeviceIsOpened) {
  expectRefused({"missing.json"}, {"missing.json"});
  expectRefused({"scene.json", "--set", "fluid.viscosty=1"}, {"fluid.viscosty", "\"viscosity\""});
  expectRefused({"scene.json", "--set", "fluid.spacing=-1"}, {"fluid.spacing"});
  expectRefused({"scene.json", "--set", "fluid.spacing=1e-6"}, {"fluid.spacing"});
  expectRefused({"scene.json", "--set", "rill=99.0"}, {"99.0"});
  expectRefused({"scene.json", "--set", "duration=1e9"}, {"frames"});
}

TEST(CommandLine, PlacesAreJudgedBeforeADeviceIsOpened) {
  expectRefused({"scene.json", "--out", "scene.json"}, {"--out", "is a file; expected a folder"});
  expectRefused({"scene.json", "--out", "scene.json/deeper"}, {"--out", "is a file"});
  expectRefused({"scene.json", "--stats", "."}, {"--stats", "is a folder"});
  expectRefused({"scene.json", "--stats", "scene.json/stats.json"}, {"--stats", "is a file"});
  expectRefused({"scene.json", "--stats", "/dev/rill-none"}, {"--stats", "/dev/rill-none"});
  expectRefused({"scene.json", "--checkpoint", "."}, {"--checkpoint", "is a folder"});
  expectRefused({"scene.json", "--checkpoint", "scene.json/run.rill"}, {"--checkpoint", "is a file"});
  expectRefused({"scene.json", "--video", "scene.json/a.mp4"}, {"--video", "is a file"});
  expectRefused({"scene.json", "--resume", "none.rill"}, {"--resume", "\"none.rill\" is not there"});
  expectRefused({"scene.json", "--resume", "scene.json"}, {"--resume", "is no checkpoint"});
}

Expected<rill::apps::CommandLine<capture::Options>> parsed(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "rill-capture");
  return rill::capture::parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Options, ListsTakeSeveralValuesAndLeaveTheScene) {
  for (const auto& arguments :
       {std::vector{"dam-break", "--set", "a=1", "b=2", "--require", "outside<1", "non_finite<1", "--quiet"},
        std::vector{"--set", "a=1", "b=2", "--require", "outside<1", "non_finite<1", "--quiet", "dam-break"},
        std::vector{"--set", "a=1", "--quiet", "--require", "outside<1", "--set", "b=2", "dam-break", "--require", "non_finite<1"}}) {
    const auto line = parsed(arguments);
    ASSERT_TRUE(line) << line.error().message;
    EXPECT_EQ(line->options->scene, "dam-break");
    ASSERT_EQ(line->options->overrides.size(), 2u);
    EXPECT_EQ(line->options->overrides[1].key, "b");
    ASSERT_EQ(line->options->requirements.size(), 2u);
    EXPECT_EQ(line->options->requirements[1].figure, "non_finite");
    EXPECT_TRUE(line->options->quiet);
  }
}

TEST(Options, DefaultsAreTheDocumentedOnes) {
  const auto line = parsed({"dam-break"});
  ASSERT_TRUE(line);
  EXPECT_FALSE(line->options->frames);
  EXPECT_EQ(line->options->fps, 60);
  EXPECT_EQ(line->options->width, 1280u);
  EXPECT_EQ(line->options->height, 720u);
  EXPECT_EQ(line->options->view, "final");
  EXPECT_TRUE(line->options->images);
  EXPECT_FALSE(line->options->out);
}

TEST(Options, ParticlesReplaceTheSpacing) {
  const auto line = parsed({"dam-break", "--particles", "5000", "--set", "seed=2"});
  ASSERT_TRUE(line);
  ASSERT_EQ(line->options->overrides.size(), 2u);
  EXPECT_EQ(line->options->overrides.back().key, "fluid.particles");
  EXPECT_EQ(line->options->overrides.back().value, "5000");
}

TEST(Options, TheCommandCanBeTypedAgain) {
  const auto line = parsed({"my scene.json", "--require", "outside<1", "--size=64x32"});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->options->command, "rill-capture 'my scene.json' --require 'outside<1' --size=64x32");
}

}  // namespace
}  // namespace rill::test
