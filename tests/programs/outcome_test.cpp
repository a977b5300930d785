// Exit codes, streams, output folders and signals of rill-capture.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

#include "support/small_dam.hpp"

namespace rill::test {
namespace outcome_test {

using OutcomeTest = SmallDam;

TEST_F(OutcomeTest, EarlierFramesAreRemoved) {
  std::filesystem::create_directories(folder / "out/dam");
  folder.write("out/dam/frame_00007.png", "old");
  folder.write("out/dam/keep.txt", "mine");
  ASSERT_EQ(run({"--frames", "1", "--size", "64x36"}).code, 0);
  EXPECT_EQ(TemporaryFolder::namesIn(folder / "out/dam"), (std::vector<std::string>{"frame_00000.png", "keep.txt"}));
}

TEST_F(OutcomeTest, RejectsFolderInUse) {
  std::filesystem::create_directories(folder / "held");
  folder.write("held/frame_00000.png", "another's");
  const int held = ::open((folder / "held").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  const Outcome outcome = run({"--frames", "1", "--size", "64x36", "--out", "held"});
  ::close(held);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("another capture is writing"), std::string::npos) << outcome.err;
  EXPECT_EQ(contentOf(folder / "held/frame_00000.png"), "another's");
}

TEST_F(OutcomeTest, StandardOutputContainsOnlyJson) {
  for (const char* place : {"-", "/dev/stdout"}) {
    const Outcome outcome = run({"--frames", "2", "--no-images", "--stats", place});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["frames"].size(), 2u);
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"dam.json"});
}

TEST_F(OutcomeTest, QuietPrintsNothing) {
  const Outcome outcome = run({"--frames", "2", "--no-images", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(OutcomeTest, PrintsLinesWithoutTerminal) {
  const Outcome outcome = run({"--frames", "2", "--no-images"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("frame 2/2  t 0.017 s  error "), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos);
  EXPECT_NE(outcome.out.find("density_error_mean "), std::string::npos) << outcome.out;
}

TEST_F(OutcomeTest, FailedRequirementExitsWith3) {
  const Outcome outcome = run({"--frames", "2", "--no-images", "--quiet", "--stats", "s.json", "--require", "particles<10", "outside<1"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("particles is 600"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("outside"), std::string::npos) << outcome.err;
  EXPECT_EQ(stats("s.json")["frames"].size(), 2u);
}

TEST_F(OutcomeTest, UnknownDeviceListsDevices) {
  const Outcome outcome = run({"--frames", "1", "--device", "no such card"});
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("no such card"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("  0  "), std::string::npos) << "the list of devices: " << outcome.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"dam.json"});
}

TEST_F(OutcomeTest, NoDriverExitsWith4) {
  const Outcome outcome = capture({scene, "--frames", "1"}, folder.string(),
                                  {{"VK_DRIVER_FILES", "/nonexistent.json"}, {"VK_ICD_FILENAMES", "/nonexistent.json"}});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"dam.json"});
}

TEST_F(OutcomeTest, SignalLeavesCompleteFrames) {
  for (const auto& [signal, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143), std::pair(SIGHUP, 129)}) {
    const std::string out = "signal" + std::to_string(code);
    Child child({std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture", scene, "--frames", "100000", "--fps", "200", "--size",
                 "64x36", "--out", out, "--stats", out + ".json"},
                folder.string());
    ASSERT_TRUE(child.waitForMessage("frame 1/"));
    child.signal(signal);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.code, code) << outcome.err;
    const Json json = stats(out + ".json");
    const std::vector<std::string> frames = TemporaryFolder::namesIn(folder / out);
    ASSERT_FALSE(frames.empty());
    EXPECT_EQ(json["frames"].size(), frames.size());
    for (size_t k = 0; k < frames.size(); ++k) {
      char name[32];
      std::snprintf(name, sizeof name, "frame_%05zu.png", k);
      EXPECT_EQ(frames[k], name) << "consecutive frames, no part files";
      expectCompletePng(folder / out / frames[k]);
    }
  }
}

TEST_F(OutcomeTest, ReaderThatExitsIsNoError) {
  Child child({std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture", scene, "--frames", "2", "--no-images", "--stats", "-"},
              folder.string());
  child.closeOut();
  const Outcome outcome = child.wait();
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err.find("Broken pipe"), std::string::npos) << outcome.err;
}

TEST_F(OutcomeTest, ClosedStreamsDoNoHarm) {
  const std::string program =
      std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture dam.json --frames 3 --size 64x36 --out made --stats s.json";
  for (const char* streams : {">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-", "| true", "--explain | head -n 1", "2>&1 | true"}) {
    const Outcome outcome = Child({"/bin/bash", "-o", "pipefail", "-c", program + " " + streams}, folder.string()).wait();
    EXPECT_EQ(outcome.code, 0) << streams << ": " << outcome.err;
    EXPECT_EQ(stats("s.json")["frames"].size(), 3u) << streams;
    EXPECT_EQ(TemporaryFolder::namesIn(folder / "made"),
              (std::vector<std::string>{"frame_00000.png", "frame_00001.png", "frame_00002.png"}))
        << streams;
    for (const std::string& name : TemporaryFolder::namesIn(folder / "made")) expectCompletePng(folder / "made" / name);
    std::filesystem::remove_all(folder / "made");
    std::filesystem::remove(folder / "s.json");
  }
}

TEST_F(OutcomeTest, FullDiskIsReported) {
  const Outcome outcome = run({"--frames", "2", "--no-images", "--stats", "/dev/full"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("No space left"), std::string::npos) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

}  // namespace outcome_test
}  // namespace rill::test
