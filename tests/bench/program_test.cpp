// End-to-end tests of rill-bench on small cases.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

using Json = nlohmann::json;

Outcome bench(std::vector<std::string> arguments, const std::string& folder = ".") {
  arguments.insert(arguments.begin(), std::string(RILL_BINARY_DIR) + "/apps/bench/rill-bench");
  return Child(arguments, folder).wait();
}

const Json* resultOf(const Json& report, const std::string& name) {
  for (const Json& result : report["results"])
    if (result["case"] == name) return &result;
  ADD_FAILURE() << "no case " << name << " in " << report.dump();
  return nullptr;
}

TEST(RillBench, KeepsWhatItMeasuredBeforeTheDeviceWasLost) {
  const TemporaryFolder folder;
  const std::string program = std::string(RILL_BINARY_DIR) + "/apps/bench/rill-bench";
  const auto free = [&](const char* plan, const char* json) {
    Child::Environment failing{
        {"VK_LAYER_PATH", RILL_LAYERS_FOLDER}, {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"}, {"RILL_TEST_FAIL", plan}};
    return Child({program, "validation", "--quick", "--only", "free", "--json", json}, folder.string(), failing).wait();
  };
  EXPECT_EQ(free("vkQueueSubmit2 20 -4", "first.json").code, 1) << "in the first of two experiments";
  EXPECT_FALSE(std::filesystem::exists(folder / "first.json"));
  const Outcome outcome = free("vkQueueSubmit2 200 -4", "second.json");
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  const Json report = Json::parse(contentOf(folder / "second.json"), nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << outcome.err;
  EXPECT_EQ(report["results"].size(), 1u);
  ASSERT_EQ(report["failures"].size(), 1u);
  EXPECT_NE(report["failures"][0].get<std::string>().find("VK_ERROR_DEVICE_LOST"), std::string::npos) << report["failures"].dump();
}

TEST(RillBench, SortWritesTableAndJson) {
  const TemporaryFolder folder;
  const Outcome outcome = bench({"sort", "--quick", "--only", "-1k", "--json", "out.json"}, folder.string());
  ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("std::stable_sort"), std::string::npos) << outcome.out;
  const Json report = Json::parse(contentOf(folder / "out.json"), nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << contentOf(folder / "out.json");
  EXPECT_EQ(report["suite"], "sort");
  EXPECT_TRUE(report["failures"].empty()) << report["failures"].dump();
  const Json* random = resultOf(report, "random-1k");
  ASSERT_NE(random, nullptr);
  EXPECT_EQ((*random)["keys"], 1000);
  for (const char* method : {"counting", "radix", "std_sort", "std_stable_sort"})
    EXPECT_EQ((*random)[method]["ms"]["samples"].size(), 5u) << method;
  const Json* many = resultOf(report, "many-1k");
  ASSERT_NE(many, nullptr);
  EXPECT_TRUE((*many)["counting"].contains("skipped")) << "counting sort does not support 2^32 values";
}

TEST(RillBench, JsonOnStdoutMovesTableToStderr) {
  const Outcome outcome = bench({"sort", "--quick", "--only", "equal-1k", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << outcome.out;
  EXPECT_NE(outcome.err.find("equal-1k"), std::string::npos) << outcome.err;
}

TEST(RillBench, SpeedTimesEachPass) {
  const Outcome outcome = bench({"speed", "--quick", "--quiet", "--only", "particles-1k", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << outcome.out;
  const Json* thousand = resultOf(report, "particles-1k");
  ASSERT_NE(thousand, nullptr);
  EXPECT_EQ((*thousand)["particles"], 1350) << "not a whole number of layers";
  EXPECT_GT((*thousand)["ns_a_particle_a_substep"]["median"], 0);
  for (const char* pass : {"density", "correct", "build list", "sort"})
    EXPECT_GT((*thousand)["passes_ns_a_particle_a_substep"][pass]["median"], 0) << pass;
}

TEST(RillBench, RenderMeasuresErrorsOfMethodsAndSettings) {
  const Outcome outcome = bench({"render", "--quick", "--only", "640x360 r 10, waves 50, ", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("front"), std::string::npos) << outcome.err;
  const Json report = Json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << outcome.out;
  std::map<std::string, std::map<std::string, double>> errors;  // degrees by method and setting
  for (const Json& result : report["results"]) {
    EXPECT_EQ(result["ms"]["samples"].size(), 3u);
    EXPECT_EQ(result.contains("jittered_anew_deg"), result["setting"] == "") << result.dump();
    errors[result["method"]][result["setting"]] = result["normal_mean_deg"];
  }
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_GT(errors["planes"][""], 0.1) << "jittered particles have an error";
  EXPECT_LT(errors["planes"][""], 1.04) << "1.25 times the measured error, docs/notes/bench.md";
  for (const auto& [method, settings] : errors) {
    EXPECT_GE(settings.size(), 3u) << method;
    for (const auto& [setting, degrees] : settings)
      if (!setting.empty()) { EXPECT_NE(degrees, settings.at("")) << method << ": " << setting << " has no effect"; }
  }
}

TEST(RillBench, RenderMeasuresFlickerOfSimulatedFrames) {
  const Outcome outcome = bench({"render", "--quick", "--quiet", "--only", "resting column, planes", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << outcome.out;
  const Json* column = resultOf(report, "resting column");
  ASSERT_NE(column, nullptr);
  EXPECT_GT((*column)["flicker_deg"], 0.001);
  EXPECT_LT((*column)["flicker_deg"], 0.91) << "1.25 times the largest error of all drivers, docs/notes/bench.md";
}

TEST(RillBench, EmptySceneRunsNoPass) {
  const Outcome outcome = bench({"features", "--quick", "--quiet", "--only", "empty, passes", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json report = Json::parse(outcome.out, nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << outcome.out;
  const Json* empty = resultOf(report, "empty, passes");
  ASSERT_NE(empty, nullptr);
  EXPECT_TRUE((*empty)["passes"].empty()) << empty->dump();
  EXPECT_EQ((*empty)["skipped"]["density"], "no particles");
}

TEST(RillBench, DisabledFeatureRunsNoPasses) {
  const Outcome outcome = bench({"features", "--quick", "--quiet", "--only", "viscosity", "--json", "-"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;  // 3 if passes or the state differ
}

TEST(RillBench, BadInputExitsWith2) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"sort", "--device", "no such device"}, {"nothing"}, {"sort", "--json", folder.string()}}) {
    const Outcome outcome = bench(arguments, folder.string());
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("rill-bench: ")) << outcome.err;
  }
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace rill::test
