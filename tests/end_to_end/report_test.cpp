// Reports of rill-capture about an image: passes, transient memory, loops that reached their limit.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace report_test {

constexpr const char* kScene = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}]
})";

/// Seen from near by, planned for something far away: the filter would reach over more samples than it has taps.
constexpr const char* kNear = R"({
  "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.3]}}], "look": {"surface": "narrow_range"},
  "camera": {"eye": [0.25, 0.25, 0.7], "target": [0.25, 0.25, -40]}
})";

TEST(PictureReport, ExplainReportsAliasing) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  const Outcome run = capture({scene, "--frames", "2", "--size", "160x90", "--explain", "--quiet"}, folder.string());
  ASSERT_EQ(run.code, 0) << run.err;
  ASSERT_NE(run.out.find("transient memory"), std::string::npos) << run.out;
  for (const char* kind : {"\nadvance, buffers ", "\nmeasure, buffers ", "\npicture, buffers ", "\npicture, images "}) {
    const size_t at = run.out.find(kind);
    ASSERT_NE(at, std::string::npos) << kind << run.out;
    unsigned resources = 0;
    double aliased = 0, separate = 0;
    ASSERT_EQ(std::sscanf(run.out.c_str() + at + std::string(kind).size(), "%u %lf %lf", &resources, &aliased, &separate), 3) << run.out;
    EXPECT_GT(resources, 0u) << kind;
    EXPECT_LE(aliased, separate) << kind;
    if (std::string(kind) == "\npicture, buffers ") { EXPECT_LT(aliased, 0.8 * separate) << run.out; }
  }
}

// The renderer scans in a pass of its own, beside a sort of the fluid's that has nothing to do.
TEST(PictureReport, ExplainTellsHowOftenAPassRan) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  const Outcome run = capture({scene, "--frames", "4", "--size", "160x90", "--explain", "--quiet"}, folder.string());
  ASSERT_EQ(run.code, 0) << run.err;
  const auto row = [&](const std::string& pass) {
    const size_t at = run.out.find("\n" + pass + " ");
    EXPECT_NE(at, std::string::npos) << pass << run.out;
    std::pair<unsigned, unsigned> counts;
    EXPECT_EQ(std::sscanf(run.out.c_str() + at + pass.size() + 1, "%u %u", &counts.first, &counts.second), 2) << pass;
    return counts;
  };
  const auto scan = row("surface scan"), correct = row("correct"), build = row("build list"), finish = row("finish rebuild");
  EXPECT_GE(scan.first, 4u);
  EXPECT_EQ(scan.second, scan.first);
  EXPECT_GT(correct.second, 0u);
  EXPECT_LE(correct.second, correct.first) << "how many blocks are recorded at a time follows the machine's speed";
  EXPECT_GT(build.second, 0u);
  EXPECT_LT(build.second, build.first) << "every block records a rebuild, few need one";
  EXPECT_EQ(finish.second, finish.first);
}

TEST(PictureReport, WritesGraph) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kScene).string();
  ASSERT_EQ(capture({scene, "--frames", "2", "--size", "160x90", "--graph", "picture.dot", "--quiet"}, folder.string()).code, 0);
  ASSERT_EQ(capture({scene, "--frames", "2", "--no-images", "--graph", "advance.dot", "--quiet"}, folder.string()).code, 0);
  const std::string picture = contentOf(folder / "picture.dot"), advance = contentOf(folder / "advance.dot");
  EXPECT_EQ(picture.substr(0, 13), "digraph frame");
  EXPECT_NE(picture.find("  surface splat\""), std::string::npos);
  EXPECT_EQ(advance.find("  surface splat\""), std::string::npos);
  EXPECT_NE(advance.find("  density\""), std::string::npos);
}

TEST(PictureReport, ReachedLimitsAreCountedAndReported) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", kNear).string();
  const Outcome lost =
      capture({scene, "--frames", "1", "--size", "320x180", "--stats", "lost.json", "--export", "ply", "--out", "frames"}, folder.string());
  ASSERT_EQ(lost.code, 0) << lost.err;
  EXPECT_GT(nlohmann::json::parse(contentOf(folder / "lost.json"))["frames"][0]["picture_bound_hits"].get<int>(), 0);
  EXPECT_NE(lost.err.find("warning: loops of the renderer's shaders reached their limit"), std::string::npos) << lost.err;
  EXPECT_EQ(lost.out.find("picture_bound_hits       0"), std::string::npos) << lost.out;

  const Outcome played =
      capture({scene, "--play", "frames", "--size", "320x180", "--out", "played", "--graph", "played.dot"}, folder.string());
  ASSERT_EQ(played.code, 0) << played.err;
  EXPECT_NE(contentOf(folder / "played.dot").find("  surface splat\""), std::string::npos);
  EXPECT_NE(played.err.find("warning: loops of the renderer's shaders reached their limit"), std::string::npos) << played.err;

  const std::string water = folder.write("water.json", kScene).string();
  const Outcome whole = capture({water, "--frames", "3", "--size", "160x90", "--stats", "whole.json"}, folder.string());
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.err.find("warning"), std::string::npos) << whole.err;
  EXPECT_NE(whole.out.find("picture_bound_hits       0\n"), std::string::npos) << whole.out;
}

}  // namespace report_test
}  // namespace rill::test
