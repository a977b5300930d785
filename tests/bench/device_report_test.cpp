// The suite `device`: its report, what it leaves out, and what it does with files.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/device/self_check.hpp"
#include "bench/report.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

Outcome device(std::vector<std::string> arguments, const std::string& folder) {
  // Without a display, whatever the tests run in.
  std::vector<std::string> all = {
      "/usr/bin/env", "-u",     "DISPLAY", "-u", "WAYLAND_DISPLAY", std::string(RILL_BINARY_DIR) + "/apps/bench/rill-bench",
      "device",       "--quiet"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return Child(all, folder).wait();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(DeviceReport, ChecksTheDeviceAndEndsWithATableForAnIssue) {
  const TemporaryFolder folder;
  const Outcome outcome = device({"--only", "s", "--budget", "10", "--report", "report.md", "--json", "report.json"}, folder.string());
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  const std::string report = contentOf(folder / "report.md");
  EXPECT_TRUE(report.starts_with("# rill-bench device: ")) << report;
  for (const std::string& name : bench::selfCheckNames())
    EXPECT_TRUE(contains(report, "| " + name + " | passed |")) << name << "\n" << report;
  for (const char* part : {"| subgroup size required |", "| arrays are read through |", "| copies, read and written |", "| 4,000,000 |"})
    EXPECT_TRUE(contains(report, part)) << part << "\n" << report;
  const size_t last = report.rfind("## ");
  EXPECT_EQ(report.substr(last, 15), "## For an issue") << report;
  const std::string count = std::to_string(bench::selfCheckNames().size());
  EXPECT_TRUE(contains(report.substr(last), "| checks | " + count + " of " + count + " passed |")) << report;

  // Ten seconds are too few for four million particles: it says so, and why.
  const auto json = nlohmann::json::parse(contentOf(folder / "report.json"), nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  size_t sizes = 0;
  for (const auto& result : json["results"]) {
    if (!std::string(result["case"]).starts_with("simulation-")) continue;
    ++sizes;
    EXPECT_TRUE(result.contains("left_out") || result["frame_ms"] > 0) << result.dump();
    if (result["case"] != "simulation-4M") continue;
    EXPECT_TRUE(contains(result["left_out"], "take about") || contains(result["left_out"], "memory"));
  }
  EXPECT_EQ(sizes, 4u);
}

TEST(DeviceReport, SaysWhyThereIsNoViewer) {
  const TemporaryFolder folder;
  const Outcome outcome = device({"--only", "viewer", "--report", "report.md"}, folder.string());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(contentOf(folder / "report.md"), "left out: no display")) << contentOf(folder / "report.md");
}

TEST(DeviceReport, KeepsAnOldReportIfItCannotRun) {
  const TemporaryFolder folder;
  std::ofstream(folder / "report.md") << "old";
  const Outcome noDevice = device({"--device", "no such card", "--report", "report.md"}, folder.string());
  EXPECT_EQ(noDevice.code, 2) << noDevice.err;
  EXPECT_EQ(contentOf(folder / "report.md"), "old");
  const Outcome noCase = device({"--only", "no such case", "--report", "report.md"}, folder.string());
  EXPECT_EQ(noCase.code, 2) << noCase.err;
  EXPECT_EQ(contentOf(folder / "report.md"), "old");
}

TEST(DeviceReport, RefusesAFolderInPlaceOfTheFileBeforeItRuns) {
  const TemporaryFolder folder;
  const Outcome outcome = device({"--report", "."}, folder.string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.err, "--report: \".\" is a folder")) << outcome.err;
}

TEST(DeviceReport, MakesTheFolderOfTheReport) {
  const TemporaryFolder folder;
  const Outcome outcome = device({"--only", "viewer", "--report", "new/folder/report.md"}, folder.string());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contentOf(folder / "new/folder/report.md").starts_with("# rill-bench device"));
}

TEST(DeviceReport, RefusesBudgetsOutOfRangeOrOfOtherSuites) {
  const TemporaryFolder folder;
  for (const char* budget : {"9", "3601", "-1", "1e2", "ten", ""}) {
    const Outcome outcome = device({"--budget", budget}, folder.string());
    EXPECT_EQ(outcome.code, 2) << budget;
    EXPECT_TRUE(contains(outcome.err, "--budget: found \"" + std::string(budget) + "\"")) << outcome.err;
  }
  const Outcome other = Child({std::string(RILL_BINARY_DIR) + "/apps/bench/rill-bench", "sort", "--budget", "60"}, folder.string()).wait();
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.err, "expected the suite device")) << other.err;
}

TEST(TableMarkdown, EscapesWhatWouldEndACell) {
  const bench::Table table{"T", {"a", "b"}, {{"x|y", "1\n2"}}, "note"};
  EXPECT_EQ(bench::tableMarkdown(table), "## T\n\n| a | b |\n| --- | --- |\n| x\\|y | 1<br>2 |\n\nnote\n");
}

}  // namespace
}  // namespace rill::test
