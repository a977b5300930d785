// Errors of rill-capture about bad input. Input is validated before a device is opened: no test here needs Vulkan.
#include <gtest/gtest.h>

#include <algorithm>

#include "capture/options.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

constexpr const char* kScene = R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"min": [0,0,0], "max": [1,1,1]},
  "fill": [{"box": {"min": [0,0,0], "max": [0.5,0.5,0.5]}}], "probes": [{"name": "H1", "level": [0.2, 0.2]}]})";

/// Expects exit code 2, `words` in the message, no control characters, nothing on standard output, no new files.
void expectRefused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const Outcome outcome = capture(arguments, folder.string());
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("rill-capture: ")) << outcome.err;
  for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " is not in: " << outcome.err;
  for (const char c : outcome.err) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << "raw byte in: " << outcome.err;
  EXPECT_LT(outcome.err.size(), 2000u);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.json"}) << "nothing is written";
}

TEST(CommandLine, HelpListsOptionsAndExamples) {
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
                             "--exposure",
                             "--samples",
                             "--shutter",
                             "--aperture",
                             "--focus",
                             "--exr",
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

TEST(CommandLine, HelpReportsFullDisk) {
  const Outcome full = capture({"--help"}, ".", {}, "/dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_NE(full.err.find("No space left"), std::string::npos) << full.err;
}

TEST(CommandLine, ErrorsNameOptionAndExpectedValue) {
  expectRefused({}, {"SCENE"});
  expectRefused({"scene.json", "--frmes", "3"}, {"\"--frmes\"", "did you mean \"--frames\"?", "--help"});
  expectRefused({"scene.json", "--frames"}, {"--frames"});
  for (const char* bad : {"0", "-1", "3.5", "x", "", "99999999999999999999"})
    expectRefused({"scene.json", "--frames", bad}, {"--frames", "expected a whole number from 1"});
  for (const char* bad : {"0", "-60", "nan", "inf", "60x"}) expectRefused({"scene.json", "--fps", bad}, {"--fps", "expected a number"});
  for (const char* bad : {"640", "640x", "x480", "640x480x2", "0x480", "640*480", "9000x10", "8192x8192"})
    expectRefused({"scene.json", "--size", bad}, {"--size", "as 1280x720"});
  for (const char* bad : {"10.5", "-11", "nan", "inf", "bright", ""})
    expectRefused({"scene.json", "--exposure", bad}, {"--exposure", "expected a number of stops from -10 to 10"});
  expectRefused({"scene.json", "--exposure", "1", "--no-images"}, {"--exposure", "--no-images without --video", "images to expose"});
  expectRefused({"scene.json", "--exposure", "1", "--view", "depth"}, {"--exposure", "the view depth has none", "expected --view final"});
  for (const char* bad : {"0", "257", "-1", "2.5", "many", ""})
    expectRefused({"scene.json", "--samples", bad}, {"--samples", "expected a whole number from 1 to 256"});
  for (const char* bad : {"-1", "361", "nan", "half", ""})
    expectRefused({"scene.json", "--shutter", bad}, {"--shutter", "expected a number of degrees from 0 to 360"});
  for (const char* bad : {"0", "0.4", "65", "nan", "f/2.8", ""})
    expectRefused({"scene.json", "--aperture", bad}, {"--aperture", "expected an f-number from 0.5 to 64"});
  for (const char* bad : {"0", "-1", "inf", "near", ""})
    expectRefused({"scene.json", "--aperture", "2.8", "--focus", bad}, {"--focus", "expected a distance from 0.001 to 1000000 m"});
  expectRefused({"scene.json", "--focus", "2"}, {"--focus", "no --aperture", "expected both"});
  for (const char* other : {"--shutter", "--aperture"})
    expectRefused({"scene.json", "--samples", "1", other, "4"}, {"--samples", "found 1 with " + std::string(other), "at least 2"});
  for (const char* option : {"--samples", "--shutter", "--aperture"}) {
    expectRefused({"scene.json", option, "4", "--no-images"}, {option, "--no-images without --video", "images to draw"});
    expectRefused({"scene.json", option, "4", "--view", "depth"}, {option, "the view depth has no film effects", "expected --view final"});
  }
  expectRefused({"scene.json", "--export", "obj"}, {"--export", "expected ply, mesh, vtk or poses"});
  expectRefused({"scene.json", "--export", "mesh", "--mesh-format", "stl"}, {"--mesh-format", "\"stl\"", "ply, obj, glb or vtp"});
  expectRefused({"scene.json", "--export", "mesh", "--mesh-cell", "0.1"}, {"--mesh-cell", "0.1", "0.25 to 1"});
  expectRefused({"scene.json", "--mesh-cell", "0.5"}, {"--mesh-cell", "needs --export mesh"});
  expectRefused({"scene.json", "--export", "ply", "--mesh-format", "ply"}, {"--mesh-format", "needs --export mesh"});
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
  expectRefused({"scene.json", "other.json"}, {"\"other.json\"", "unexpected argument"});
  expectRefused({"scene.json", "--frames", "2", "--frames", "3"}, {"--frames"});
}

TEST(CommandLine, UnknownNamesListKnownOnes) {
  expectRefused({"scene.json", "--size", "8192x4096"}, {"--size, --view final", "8192x4096", "16777216"});
  expectRefused({"scene.json", "--view", "particels"},
                {"\"particels\"", "did you mean \"particles\"?", "views: final, particles, density, speed, depth, normals, thickness"});
  expectRefused({"dam-brake"}, {"\"dam-brake\"", "did you mean \"dam-break\"?", "resting-column", "validation/martin-moyce-1"});
  expectRefused({"scene.json", "--require", "outsid<1"}, {"\"outsid\"", "did you mean \"outside\"?", "density_error_p99", "probes.H1"});
}

TEST(CommandLine, RejectsMalformedRequirements) {
  for (const char* bad : {"outside", "outside=1", "<1", "outside<one"})
    expectRefused({"scene.json", "--require", bad}, {"--require", "expected FIGURE<NUMBER"});
}

TEST(CommandLine, RejectsInvalidScenesWithoutDevice) {
  expectRefused({"missing.json"}, {"missing.json"});
  expectRefused({"scene.json", "--set", "fluid.viscosty=1"}, {"fluid.viscosty", "\"viscosity\""});
  expectRefused({"scene.json", "--set", "fluid.spacing=-1"}, {"fluid.spacing"});
  expectRefused({"scene.json", "--set", "fluid.spacing=1e-6"}, {"fluid.spacing"});
  expectRefused({"scene.json", "--set", "rill=99.0"}, {"99.0"});
  expectRefused({"scene.json", "--set", "duration=1e9"}, {"frames"});
}

TEST(CommandLine, RejectsUnwritableOutputsWithoutDevice) {
  expectRefused({"scene.json", "--out", "scene.json"}, {"--out", "is a file; expected a folder"});
  expectRefused({"scene.json", "--out", "scene.json/deeper"}, {"--out", "is a file"});
  expectRefused({"scene.json", "--stats", "."}, {"--stats", "is a folder"});
  expectRefused({"scene.json", "--stats", "scene.json/stats.json"}, {"--stats", "is a file"});
  expectRefused({"scene.json", "--stats", "/dev/rill-none"}, {"--stats", "/dev/rill-none"});
  expectRefused({"scene.json", "--checkpoint", "."}, {"--checkpoint", "is a folder"});
  expectRefused({"scene.json", "--checkpoint", "scene.json/run.rill"}, {"--checkpoint", "is a file"});
  expectRefused({"scene.json", "--video", "scene.json/a.mp4"}, {"--video", "is a file"});
  expectRefused({"scene.json", "--resume", "none.rill"}, {"--resume", "\"none.rill\" does not exist"});
  expectRefused({"scene.json", "--resume", "scene.json"}, {"--resume", "is not a Rill checkpoint"});
}

TEST(CommandLine, MessagesContainNoControlCharacters) {
  const std::string escape = "\x1b[31m";
  expectRefused({escape + ".json"}, {"\\u001b[31m.json"});
  expectRefused({escape}, {"\\u001b[31m"});
  expectRefused({std::string("\xff\x9b") + ".json"}, {"\\xff\\x9b.json"});
  expectRefused({"scene.json", "--set", "fluid." + escape + "=1"}, {"\\u001b[31m"});
  expectRefused({"scene.json", "--out", "scene.json/" + escape}, {"--out"});
  expectRefused({"scene.json", "--view", escape}, {"--view"});
  expectRefused({"scene.json", "--" + escape}, {"unknown option"});
}

/// A scene file of this content: exit code 2, a short message of printable ASCII that contains `word`.
void expectSceneRefused(const std::string& content, const std::string& word) {
  const TemporaryFolder folder;
  folder.write("bad.json", content);
  const Outcome outcome = capture({"bad.json"}, folder.string());
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("bad.json"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  for (const char c : outcome.err) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << "raw byte in: " << outcome.err;
  EXPECT_LT(outcome.err.size(), 500u) << outcome.err;
}

TEST(CommandLine, ErrorsAboutScenesDoNotPrintTheirContent) {
  expectSceneRefused(contentOf(std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture").substr(0, 100'000), "UTF-8");
  expectSceneRefused(R"({"rill": "0.1", "a\u001b[31m\nb": 1})", R"("a\u001b[31m\u000ab": unknown key)");
  expectSceneRefused(R"({"rill": "0.1", ")" + std::string(5000, 'x') + R"(": 1})", "xxx...\": unknown key");
  expectSceneRefused(R"({"rill": "0.1\u001b[31m"})", R"(rill: found "0.1\u001b[31m")");
  expectSceneRefused("{\"rill\": \x1b[31m}", "invalid JSON");
}

/// Expects that a scene with these bytes as its PLY file is rejected with the scene, the key, the file and `word`.
void expectPlyRefused(const std::string& content, const std::string& word) {
  const TemporaryFolder folder;
  folder.write("water.ply", content);
  folder.write("scene.json", R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"min": [0,0,0], "max": [1,1,1]},
    "fill": [{"box": {"min": [0,0,0], "max": [0.5,0.5,0.5]}}, {"particles": {"file": "water.ply"}}]})");
  const Outcome outcome = capture({"scene.json"}, folder.string());
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  for (const std::string& part : {std::string("scene.json: fill[1].particles.file: "), std::string("water.ply: "), word})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << " is not in: " << outcome.err;
  for (const char c : outcome.err) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << "raw byte in: " << outcome.err;
  EXPECT_LT(outcome.err.size(), 500u) << outcome.err;
}

TEST(CommandLine, ErrorsAboutPlyFilesNameSceneAndKey) {
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  expectPlyRefused("ply\n", "expected a line end_header");
  expectPlyRefused("\x89PNG\r\n\x1a\n", "expected a PLY file");
  expectPlyRefused(header + "0 0\n", "expected a complete file");
  expectPlyRefused(header + "0 0 0\n0 0 \x1b[31mred\n", R"(vertex 1, property "z": found "\u001b[31mred", expected a number)");
  expectPlyRefused(header + "0 0 0\n0 0 nan\n", "vertex 1: the position is nan along z; expected a finite number");
}

// The limit is below what 4 million particles and the program itself need.
TEST(CommandLine, TooLittleMemoryReportsBytes) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const std::string program = std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture";
  const Outcome outcome =
      Child({"/bin/sh", "-c", "ulimit -v 100000 && exec " + program + " scene.json --particles 4000000"}, folder.string()).wait();
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("scene.json: not enough memory for the "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("they need at least 9"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("at most 97.66 MiB are available"), std::string::npos) << outcome.err;
}

TEST(CommandLine, ClosedStandardOutputForStatsIsRejected) {
  const TemporaryFolder folder;
  folder.write("scene.json", kScene);
  const std::string program = std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture";
  const Outcome outcome = Child({"/bin/sh", "-c", "exec " + program + " scene.json --stats - >&-"}, folder.string()).wait();
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("--stats: standard output is closed"), std::string::npos) << outcome.err;
}

Expected<rill::apps::CommandLine<capture::Options>> parsed(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "rill-capture");
  return rill::capture::parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Options, ListOptionsDoNotConsumeScene) {
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

TEST(Options, DefaultsMatchHelp) {
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

TEST(Options, ParticlesOverrideSpacing) {
  const auto line = parsed({"dam-break", "--particles", "5000", "--set", "seed=2"});
  ASSERT_TRUE(line);
  ASSERT_EQ(line->options->overrides.size(), 2u);
  EXPECT_EQ(line->options->overrides.back().key, "fluid.particles");
  EXPECT_EQ(line->options->overrides.back().value, "5000");
}

TEST(Options, CommandIsQuotedForShell) {
  const auto line = parsed({"my scene.json", "--require", "outside<1", "--size=64x32"});
  ASSERT_TRUE(line);
  EXPECT_EQ(line->options->command, "rill-capture 'my scene.json' --require 'outside<1' --size=64x32");
}

}  // namespace
}  // namespace rill::test
