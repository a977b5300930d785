// rill-capture --video: the file as ffprobe reads it, and failures of ffmpeg.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/child_process.hpp"
#include "support/picture.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace video_test {

using Json = nlohmann::json;

constexpr const char* kScene = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1.6, 0.8, 0.4]}, "fluid": {"spacing": 0.1},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.6, 0.5, 0.4]}}], "camera": {"eye": [2.4, 1.0, 2.0], "target": [0.75, 0.25, 0.2], "fov_y_deg": 38}
})";

class VideoTest : public ::testing::Test {
 protected:
  void SetUp() override { folder.write("scene.json", kScene); }

  Outcome run(std::vector<std::string> arguments, const Child::Environment& environment = {}) const {
    arguments.insert(arguments.begin(), {"scene.json", "--size", "97x55", "--fps", "20"});
    return capture(arguments, folder.string(), environment);
  }
  /// The output of ffprobe, which decodes all frames.
  Json probe(const std::string& name) const {
    const Outcome outcome =
        Child({"/usr/bin/env", "ffprobe", "-v", "error", "-count_frames", "-show_streams", "-show_format", "-of", "json", name},
              folder.string())
            .wait();
    EXPECT_EQ(outcome.err, "");
    return Json::parse(outcome.out, nullptr, false);
  }
  /// Puts a script named ffmpeg first on PATH.
  Child::Environment fakeFfmpeg(const std::string& script) const {
    std::filesystem::create_directory(folder / "bin");
    const auto file = folder.write("bin/ffmpeg", "#!/bin/sh\n" + script);
    ::chmod(file.c_str(), 0755);
    return {{"PATH", (folder / "bin").string() + ":/usr/bin:/bin"}};
  }

  TemporaryFolder folder;
};

TEST_F(VideoTest, ContainsAllFrames) {
  for (const auto& [name, format] : {std::pair("a.mp4", "mp4"), std::pair("a.mkv", "matroska"), std::pair("it's $(new) %d.mov", "mov")}) {
    const Outcome outcome = run({"--frames", "5", "--no-images", "--video", name});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(std::string("video: ") + name), std::string::npos) << outcome.err;
    const Json json = probe(name);
    ASSERT_EQ(json["streams"].size(), 1u) << json;
    const Json& stream = json["streams"][0];
    EXPECT_EQ(stream["codec_name"], "h264");
    EXPECT_EQ(stream["pix_fmt"], "yuv420p");
    EXPECT_EQ(stream["width"], 98) << "padded to even";
    EXPECT_EQ(stream["height"], 56);
    EXPECT_EQ(stream["r_frame_rate"], "20/1");
    EXPECT_EQ(stream["nb_read_frames"], "5");
    EXPECT_EQ(stream["color_space"], "bt709");
    EXPECT_EQ(stream["color_range"], "tv");
    EXPECT_NE(json["format"]["format_name"].get<std::string>().find(format), std::string::npos) << json["format"];
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.mkv", "a.mp4", "it's $(new) %d.mov", "scene.json"}));
}

TEST_F(VideoTest, FramesMatchImages) {
  ASSERT_EQ(run({"--frames", "3", "--out", "out", "--video", "made/here/a.mp4"}).code, 0);
  const Outcome decoded = Child({"/usr/bin/env", "ffmpeg", "-v", "error", "-i", "made/here/a.mp4", "seen_%d.png"}, folder.string()).wait();
  ASSERT_EQ(decoded.code, 0) << decoded.err;
  for (int k = 0; k < 3; ++k) {
    const Picture made = readPicture(folder / ("out/frame_0000" + std::to_string(k) + ".png"));
    const Picture seen = readPicture(folder / ("seen_" + std::to_string(k + 1) + ".png"));
    ASSERT_EQ(made.width, 97u);
    ASSERT_EQ(seen.width, 98u);
    ASSERT_EQ(seen.height, 56u);
    Picture cut = made;  // without the padding
    double border = 0;
    for (uint32_t y = 0; y < 55; ++y) {
      for (size_t i = 0; i < 97 * 3; ++i) cut.rgb[y * 97 * 3 + i] = seen.rgb[y * 98 * 3 + i];
      for (size_t c = 0; c < 3; ++c) border += std::abs(int(seen.rgb[(y * 98 + 97) * 3 + c]) - int(made.rgb[(y * 97 + 96) * 3 + c]));
    }
    const Distance apart = distance(made, cut);
    EXPECT_LE(apart.mean, 0.01) << "the colors match the image";
    EXPECT_LE(apart.worst, 0.04);
    EXPECT_LE(border / (55 * 3), 12) << "the added column repeats the last";
  }
}

TEST_F(VideoTest, SignalLeavesCompleteVideo) {
  Child child({std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture", "scene.json", "--frames", "100000", "--fps", "200", "--size",
               "64x36", "--no-images", "--video", "a.mp4", "--stats", "a.json"},
              folder.string());
  ASSERT_TRUE(child.waitForMessage("frame 1/"));
  child.signal(SIGINT);
  const Outcome outcome = child.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  const auto frames = Json::parse(contentOf(folder / "a.json"))["frames"].size();
  EXPECT_GE(frames, 1u);
  EXPECT_EQ(probe("a.mp4")["streams"][0]["nb_read_frames"], std::to_string(frames));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.json", "a.mp4", "scene.json"}));
}

TEST_F(VideoTest, WorksWithPlay) {
  ASSERT_EQ(run({"--frames", "3", "--no-images", "--export", "ply", "--out", "in"}).code, 0);
  ASSERT_EQ(run({"--play", "in", "--no-images", "--video", "a.mp4"}).code, 0);
  EXPECT_EQ(probe("a.mp4")["streams"][0]["nb_read_frames"], "3");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.mp4", "in", "scene.json"}));
  // After an error the video of the frames so far remains.
  folder.write("in/frame_00002.ply", "ply\n");
  const Outcome broken = run({"--play", "in", "--no-images", "--video", "a.mp4"});
  EXPECT_EQ(broken.code, 2);
  EXPECT_NE(broken.err.find("frame_00002.ply"), std::string::npos) << broken.err;
  EXPECT_EQ(probe("a.mp4")["streams"][0]["nb_read_frames"], "2");
  const Outcome nothing = run({"--play", "in", "--no-images"});
  EXPECT_EQ(nothing.code, 2);
  EXPECT_NE(nothing.err.find("expected --video FILE"), std::string::npos) << nothing.err;
}

TEST_F(VideoTest, MissingFfmpegExitsBeforeRun) {
  std::filesystem::create_directory(folder / "bin");
  const Outcome outcome = run({"--frames", "2", "--video", "a.mp4", "--stats", "a.json"}, {{"PATH", (folder / "bin").string()}});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--video: needs the program ffmpeg"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("apt-get install ffmpeg"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"bin", "scene.json"}));
}

TEST_F(VideoTest, FfmpegFailureReportsItsOutput) {
  folder.write("a.mp4", "of an earlier run");
  struct Case {
    const char* script;
    std::vector<const char*> words;
  };
  const Case cases[] = {
      {"head -c 20000 >/dev/null; echo 'frame 1: No space left on device' >&2; exit 7\n",
       {"--video: ffmpeg failed with exit code 7", "No space left on device"}},
      {"head -c 20000 >/dev/null; kill -9 $$\n", {"--video: ffmpeg was killed: Killed"}},
      {"cat >/dev/null; echo 'the trailer could not be written' >&2; exit 1\n", {"exit code 1", "the trailer could not"}},
      {"exit 0\n", {"--video: can't write to ffmpeg"}},
      {"cat >/dev/null\n", {"--video: ffmpeg wrote nothing"}},
  };
  for (const Case& failing : cases) {
    const Outcome outcome = run({"--frames", "20", "--no-images", "--video", "a.mp4"}, fakeFfmpeg(failing.script));
    EXPECT_EQ(outcome.code, 1) << failing.script;
    for (const char* word : failing.words) EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " is not in: " << outcome.err;
    EXPECT_EQ(contentOf(folder / "a.mp4"), "of an earlier run");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.mp4", "bin", "scene.json"})) << "no part file is left";
  }
}

// Like a full disk, which is reported only when the last bytes are written.
TEST_F(VideoTest, FullDiskLeavesNoVideo) {
  const auto environment = fakeFfmpeg("trap '' XFSZ; ulimit -f 2; PATH=${PATH#*:}; exec ffmpeg \"$@\"\n");
  const Outcome outcome = run({"--frames", "20", "--no-images", "--video", "a.mp4"}, environment);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"bin", "scene.json"}));
}

// ffmpeg gets uncompressed frames and does not read the terminal.
TEST_F(VideoTest, FfmpegReceivesRawFrames) {
  const auto environment = fakeFfmpeg("printf '%s\\n' \"$@\" >words; cat >pictures; for last; do :; done; echo done >\"${last#file:}\"\n");
  const Outcome outcome = run({"--frames", "2", "--no-images", "--video", "a.mp4"}, environment);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(contentOf(folder / "pictures").size(), 2u * 97 * 55 * 4);
  const std::string words = contentOf(folder / "words");
  for (const char* word : {"-nostdin\n", "rgb0\n", "97x55\n", "20\n", "libx264\n", "mp4\n"})
    EXPECT_NE(words.find(word), std::string::npos) << words;
  EXPECT_EQ(contentOf(folder / "a.mp4"), "done\n");
}

}  // namespace video_test
}  // namespace rill::test
