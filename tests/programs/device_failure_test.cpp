// A lost device, exhausted memory, a shader that the driver rejects: rill-capture reports the operation, exits with 1 and
// leaves complete files. tests/layers/failing.cpp makes the calls fail.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace device_failure_test {

constexpr const char* kDrop = R"({
  "rill": "0.1", "duration": 1,
  "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
  "fluid": {"spacing": 0.1},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.5, 0.5, 0.5]}}]
})";

struct Failure {
  const char* name;
  const char* plan;     ///< function, number of the call, result
  const char* message;  ///< a regular expression
  bool whileRunning;    ///< after the first frame: the figures so far are written
};

void PrintTo(const Failure& failure, std::ostream* out) { *out << failure.plan; }

class FailingLayer : public ::testing::Test {
 protected:
  Outcome run(const std::string& plan) {
    const std::string scene = folder.write("drop.json", kDrop).string();
    return capture({scene, "--frames", "6", "--size", "64x48", "--stats", "stats.json", "--export", "ply"}, folder.string(),
                   {{"VK_LAYER_PATH", RILL_LAYERS_FOLDER}, {"VK_INSTANCE_LAYERS", "VK_LAYER_RILL_failing"}, {"RILL_TEST_FAIL", plan}});
  }
  TemporaryFolder folder;
};

class DeviceFailure : public FailingLayer, public ::testing::WithParamInterface<Failure> {};

TEST_P(DeviceFailure, IsReportedAndLeavesCompleteFiles) {
  const Outcome outcome = run(GetParam().plan);
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(std::regex_search(outcome.err, std::regex(GetParam().message))) << outcome.err;
  ASSERT_EQ(std::filesystem::exists(folder / "stats.json"), GetParam().whileRunning);
  if (GetParam().whileRunning) {
    EXPECT_LT(nlohmann::json::parse(contentOf(folder / "stats.json"))["frames"].size(), 6u) << "figures of the frames so far";
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.string())) {
    if (!entry.is_regular_file()) continue;
    const std::string bytes = contentOf(entry.path());
    const auto extension = entry.path().extension();
    EXPECT_TRUE(extension == ".json" || extension == ".png" || extension == ".ply") << "left behind: " << entry.path();
    if (extension == ".png") { EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND") << entry.path(); }
  }
}

TEST_F(FailingLayer, DeviceMemoryErrorReportsBytes) {
  const Outcome outcome = run("vkAllocateMemory 5 -2");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(std::regex_search(outcome.err, std::regex("125 particles need [0-9,]+ MiB on the device; \".*\" has [0-9,]+ MiB")))
      << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    Calls, DeviceFailure,
    ::testing::Values(
        Failure{"LostAtSubmit", "vkQueueSubmit2 4 -4", "submitting frame 4 on .*VK_ERROR_DEVICE_LOST", true},
        Failure{"LostWhileWaiting", "vkWaitSemaphores 3 -4", "waiting for frame [0-9]+ on .*VK_ERROR_DEVICE_LOST", true},
        Failure{"NoDeviceMemory", "vkAllocateMemory 5 -2", "allocating .* for buffer '.*VK_ERROR_OUT_OF_DEVICE_MEMORY", false},
        Failure{"NoHostMemory", "vkCreateBuffer 2 -1", "creating buffer '.*VK_ERROR_OUT_OF_HOST_MEMORY", false},
        Failure{"ShaderModule", "vkCreateShaderModule 3 -13", "creating the module of shader '.*-13", false},
        Failure{"Pipeline", "vkCreateComputePipelines 3 -3", "compiling the pipeline of shader '.*VK_ERROR_INITIALIZATION_FAILED", false}),
    [](const auto& failure) { return failure.param.name; });

// The layer itself changes nothing: the call that would fail never comes.
TEST_F(FailingLayer, HasNoEffectWithoutFailure) {
  const Outcome outcome = run("vkQueueSubmit2 1000000 -4");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "stats.json"));
}

}  // namespace device_failure_test
}  // namespace rill::test
