#pragma once
// Runs of rill-capture that write checkpoints and resume from them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rill/offline.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace checkpoint_test {

using Json = nlohmann::json;

inline constexpr const char* kDam = R"({
  "rill": "0.1", "duration": 0.1,
  "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]},
  "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.52, 0.5, 0.3]}, "jitter": 0.2}],
  "solids": [{"sphere": {"center": [0.7, 0.1, 0.15], "radius": 0.1}, "friction": 0.2,
              "motion": [{"at": 0, "translate": [0, 0, 0]}, {"at": 1, "translate": [-0.4, 0, 0]}]}],
  "gravity_changes": [{"at": 0.05, "value": [2, -9, 0]}],
  "probes": [{"name": "front", "front": "+x"}]
})";

class CheckpointTest : public ::testing::Test {
 protected:
  void SetUp() override { folder.write("dam.json", kDam); }
  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "dam.json");
    return capture(arguments, folder.string());
  }
  /// A run without images.
  void figures(std::vector<std::string> arguments, const std::vector<std::string>& settings = {}) {
    for (const char* more : {"--no-images", "--no-pass-times", "--quiet"}) arguments.emplace_back(more);
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
  std::vector<Json> frames(const std::string& name) const {
    std::vector<Json> all;
    const Json json = Json::parse(contentOf(folder / name));
    for (Json frame : json["frames"]) {
      for (const char* key : {"wall_s", "pass_ms", "skipped"}) frame.erase(key);
      all.push_back(std::move(frame));
    }
    return all;
  }
  void expectRefused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
    const auto before = folder.names();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " is not in: " << outcome.err;
    EXPECT_EQ(folder.names(), before) << "nothing is written";
  }
  /// Refuses a checkpoint of which `change` damages the fluid.
  template <class Change>
  void expectDamageRefused(offline::Checkpoint damaged, const Change& change, const std::string& message) {
    change(damaged.fluid);
    const auto bytes = offline::encodeCheckpoint(damaged);
    folder.write("damaged.rill", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    expectRefused({"--resume", "damaged.rill"}, {"--resume: \"damaged.rill\": the state does not fit the scene: " + message});
  }

  TemporaryFolder folder;
};

}  // namespace checkpoint_test
}  // namespace rill::test
