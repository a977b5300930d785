// rill-capture --checkpoint and --resume: a resumed run equals one without interruption.
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <nlohmann/json.hpp>

#include "rill/offline.hpp"
#include "shared/body_records.h"
#include "shared/flow_records.h"
#include "shared/pressure_probe.h"
#include "shared/solid_records.h"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"
#include "support/tetrahedron_files.hpp"

namespace rill::test {
namespace checkpoint_test {

using Json = nlohmann::json;

constexpr const char* kDam = R"({
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

TEST_F(CheckpointTest, ResumedRunEqualsUninterruptedRun) {
  const std::vector<std::vector<std::string>> scenes = {
      {},
      {"solver.neighbors=grid"},
      {"solver.iterations=3", "fluid.tensile=0.3", "fluid.viscosity=2", "fluid.vorticity=0.3"},
      {"solver.kernel=poly6_spiky", "domain.open=[\"+x\"]"},
  };
  for (const auto& settings : scenes) {
    SCOPED_TRACE(settings.empty() ? "defaults" : settings.front());
    figures({"--frames", "8", "--stats", "whole.json"}, settings);
    figures({"--frames", "4", "--checkpoint", "run.rill", "--stats", "first.json"}, settings);
    figures({"--frames", "4", "--resume", "run.rill", "--stats", "rest.json"}, settings);
    auto whole = frames("whole.json"), pieces = frames("first.json");
    const auto rest = frames("rest.json");
    pieces.insert(pieces.end(), rest.begin(), rest.end());
    EXPECT_EQ(pieces, whole) << "all figures and times, bitwise";
  }
}

TEST_F(CheckpointTest, ResumesFromEveryFrame) {
  figures({"--frames", "4", "--stats", "whole.json"});
  const auto whole = frames("whole.json");
  figures({"--frames", "1", "--checkpoint", "run.rill"});
  for (size_t k = 1; k < 4; ++k) {  // each resumes from the one before, in the same file
    figures({"--frames", "1", "--resume", "run.rill", "--checkpoint", "run.rill", "--stats", "one.json"});
    EXPECT_EQ(frames("one.json"), std::vector<Json>{whole[k]}) << k;
  }
}

TEST_F(CheckpointTest, WritingDoesNotChangeResults) {
  figures({"--frames", "6", "--stats", "without.json"});
  figures({"--frames", "6", "--stats", "with.json", "--checkpoint", "made/run.rill", "--checkpoint-every", "0"});
  EXPECT_EQ(frames("with.json"), frames("without.json"));
  EXPECT_EQ(TemporaryFolder::namesIn(folder / "made"), std::vector<std::string>{"run.rill"}) << "no part file is left";
}

TEST_F(CheckpointTest, ResumedRunKeepsEarlierImages) {
  ASSERT_EQ(run({"--frames", "4", "--size", "64x36", "--out", "whole", "--quiet"}).code, 0);
  ASSERT_EQ(run({"--frames", "2", "--size", "64x36", "--out", "pieces", "--quiet", "--checkpoint", "run.rill"}).code, 0);
  const Outcome rest = run({"--frames", "2", "--size", "64x36", "--out", "pieces", "--resume", "run.rill"});
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_NE(rest.err.find("frame_00002.png to frame_00003.png"), std::string::npos) << rest.err;
  const auto names = TemporaryFolder::namesIn(folder / "whole");
  EXPECT_EQ(TemporaryFolder::namesIn(folder / "pieces"), names);
  for (const std::string& name : names) EXPECT_EQ(contentOf(folder / "whole" / name), contentOf(folder / "pieces" / name)) << name;
}

TEST_F(CheckpointTest, ResumedRunEndsAtSceneDuration) {
  figures({"--frames", "5", "--fps", "40", "--checkpoint", "run.rill"});  // the whole duration
  expectRefused({"--resume", "run.rill"}, {"--resume", "frame 4", "--frames"});
  figures({"--frames", "3", "--fps", "40", "--checkpoint", "run.rill"});
  figures({"--resume", "run.rill", "--stats", "rest.json"});
  const auto rest = frames("rest.json");
  ASSERT_EQ(rest.size(), 2u) << "at the frame rate of the checkpoint";
  EXPECT_EQ(rest.back()["time_s"], 0.1);
}

TEST_F(CheckpointTest, SignalLeavesValidCheckpoint) {
  for (const auto& [signal, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    Child child({std::string(RILL_BINARY_DIR) + "/apps/capture/rill-capture", "dam.json", "--frames", "100000", "--fps", "200",
                 "--no-images", "--no-pass-times", "--stats", "cut.json", "--checkpoint", "run.rill"},
                folder.string());
    ASSERT_TRUE(child.waitForMessage("frame 1/"));
    child.signal(signal);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.code, code) << outcome.err;
    auto pieces = frames("cut.json");
    ASSERT_FALSE(pieces.empty());
    const size_t cut = pieces.size();
    EXPECT_NE(outcome.err.find("checkpoint: run.rill, frame " + std::to_string(cut - 1)), std::string::npos) << outcome.err;
    figures({"--frames", "2", "--resume", "run.rill", "--stats", "rest.json"});
    for (Json& frame : frames("rest.json")) pieces.push_back(std::move(frame));
    figures({"--frames", std::to_string(cut + 2), "--fps", "200", "--stats", "whole.json"});
    EXPECT_EQ(pieces, frames("whole.json"));
  }
}

TEST_F(CheckpointTest, FullDiskIsReported) {
  const Outcome outcome = run({"--frames", "2", "--no-images", "--stats", "s.json", "--checkpoint", "/dev/full"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("No space left"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("checkpoint: /dev/full"), std::string::npos) << "not reported as written: " << outcome.err;
  EXPECT_EQ(frames("s.json").size(), 2u) << "figures are still written";
}

TEST_F(CheckpointTest, RejectsOtherScenesWithKey) {
  figures({"--frames", "2", "--checkpoint", "run.rill"});
  expectRefused({"--resume", "run.rill", "--set", "fluid.viscosity=1"},
                {"--resume: \"run.rill\": ", "another scene", "fluid.viscosity: found 1, expected 0"});
  expectRefused({"--resume", "run.rill", "--set", "seed=7"}, {"seed: found 7, expected 1"});
  expectRefused({"--resume", "run.rill", "--set", "solids[0].friction=0"}, {"solids[0].friction: found 0, expected 0.2"});
  expectRefused({"--resume", "run.rill", "--set", "gravity_changes=[]"}, {"gravity_changes[0].at: not set, expected 0.05"});
  expectRefused({"--resume", "run.rill", "--fps", "30"}, {"--fps", "expected 60"});
  figures({"--frames", "1", "--resume", "run.rill"}, {"title=Another", "duration=9"});
}

TEST_F(CheckpointTest, RejectsInvalidFiles) {
  figures({"--frames", "2", "--checkpoint", "run.rill"});
  const std::string whole = contentOf(folder / "run.rill");
  std::string changed = whole;
  changed[whole.size() / 2] ^= 4;
  folder.write("changed.rill", changed);
  folder.write("cut.rill", whole.substr(0, whole.size() - 1));
  expectRefused({"--resume", "none.rill"}, {"--resume", "\"none.rill\" does not exist"});
  expectRefused({"--resume", "dam.json"}, {"--resume", "not a Rill checkpoint"});
  expectRefused({"--resume", "changed.rill"}, {"--resume", "is corrupted"});
  expectRefused({"--resume", "cut.rill"}, {"--resume", "is truncated"});
  expectRefused({"--resume", "."}, {"--resume", "is not a regular file"});
}

/// A box that floats, a mesh that falls on it, and one that is held for a while; pressures in the fluid and inside the box.
constexpr const char* kBodies = R"({
  "rill": "0.2", "duration": 0.2,
  "domain": {"min": [0, 0, 0], "max": [0.6, 0.8, 0.6]},
  "fluid": {"spacing": 0.05},
  "fill": [{"box": {"min": [0, 0, 0], "max": [0.6, 0.3, 0.6]}}],
  "solids": [
    {"name": "crate", "box": {"min": [0.1, 0.2, 0.1], "max": [0.35, 0.4, 0.4]}, "friction": 0.4, "body": {"density": 500}},
    {"mesh": {"file": "m.obj", "scale": 0.3}, "translation": [0.15, 0.42, 0.15], "friction": 0.3, "body": {"mass": 3, "velocity": [0, -1, 0]}},
    {"sphere": {"center": [0.45, 0.3, 0.45], "radius": 0.1}, "body": {"density": 2000, "from": 0.08}}],
  "probes": [{"name": "crate", "pose": "crate"}, {"name": "load", "load": "crate"},
             {"name": "wet", "pressure": [0.3, 0.1, 0.5]}, {"name": "floor", "pressure": [0, 0, 0.3]},
             {"name": "covered", "pressure": [0.2, 0.3, 0.2]}]
})";

TEST_F(CheckpointTest, ResumedRunOfBodiesEqualsUninterruptedRun) {
  folder.write("m.obj", tetrahedronObj());
  folder.write("dam.json", kBodies);
  figures({"--frames", "10", "--stats", "whole.json"});
  figures({"--frames", "4", "--checkpoint", "run.rill"});
  figures({"--frames", "6", "--resume", "run.rill", "--checkpoint", "end.rill", "--stats", "rest.json"});
  const auto whole = frames("whole.json"), rest = frames("rest.json");
  EXPECT_EQ(rest, std::vector<Json>(whole.begin() + 4, whole.end())) << "all figures, poses, loads and pressures, bitwise";
  for (const Json& frame : rest) EXPECT_GT(frame["probes"]["wet"].get<double>(), 0) << frame["time_s"];

  auto run = offline::Simulation::open(*loadScene(folder / "dam.json"));
  ASSERT_TRUE(run);
  for (int k = 1; k < 10; ++k) ASSERT_TRUE(run->advance(k / 60.0 - run->time()));
  const auto end = offline::loadCheckpoint(folder / "end.rill");
  const auto uninterrupted = run->checkpoint();
  ASSERT_TRUE(end && uninterrupted);
  EXPECT_EQ(end->fluid, uninterrupted->fluid);
}

TEST_F(CheckpointTest, RejectsDamagedBodies) {
  folder.write("m.obj", tetrahedronObj());
  folder.write("dam.json", kBodies);
  figures({"--frames", "2", "--checkpoint", "run.rill"});
  const auto good = offline::loadCheckpoint(folder / "run.rill");
  ASSERT_TRUE(good);
  const size_t words = good->fluid.bodies.size() / 3;  // of a body
  const auto refused = [&](const auto& change, const std::string& message) { expectDamageRefused(*good, change, message); };
  const auto nan = std::bit_cast<uint32_t>(std::numeric_limits<float>::quiet_NaN());
  refused([&](FluidSnapshot& s) { s.bodies[words + offsetof(PoseRecord, velocityY) / 4] = nan; },
          "bodies[1] has a motion that is not valid");
  refused([&](FluidSnapshot& s) { s.bodies[words + offsetof(BodyRecord, mass) / 4] = 0; }, "bodies[1]");
  refused([&](FluidSnapshot& s) { s.bodies[2 * words + offsetof(BodyRecord, mass) / 4] = nan; }, "bodies[2]");
  refused([&](FluidSnapshot& s) { s.pressures[offsetof(PressureProbeRecord, integralHigh) / 4] = nan; }, "pressures[0]");
  refused([&](FluidSnapshot& s) { s.pressures[good->fluid.pressures.size() / 3 + offsetof(PressureProbeRecord, covered) / 4] = 7; },
          "pressures[1]");
  refused([&](FluidSnapshot& s) { s.pressures.pop_back(); }, "pressures has 26 entries; expected a multiple of 9");
  refused([&](FluidSnapshot& s) { s.slips[1] = nan; }, "slips[0] is not finite");
  refused([&](FluidSnapshot& s) { s.bodies.resize(2 * words); },
          "bodies has " + std::to_string(2 * words) + " entries; expected " + std::to_string(3 * words));
  refused([&](FluidSnapshot& s) { s.slips.clear(); }, "slips has 0 entries; expected ");
  const std::string whole = contentOf(folder / "run.rill");
  folder.write("cut.rill", whole.substr(0, whole.size() / 2));
  expectRefused({"--resume", "cut.rill"}, {"--resume: \"cut.rill\" is truncated"});
}

/// An empty tank with a tap, a tap under water later, a plug, and a weir.
constexpr const char* kFlows = R"({
  "rill": "0.2", "duration": 0.5,
  "domain": {"min": [0, 0, 0], "max": [0.6, 0.8, 0.6], "outflow": {"level": 0.1}},
  "fluid": {"spacing": 0.05, "capacity": 900},
  "emitters": [{"name": "tap", "disc": {"center": [0.3, 0.7, 0.3], "radius": 0.12, "normal": [0, -1, 0]}, "flow": 0.2,
                "motion": [{"at": 0.1}, {"at": 0.4, "translate": [0.1, 0, -0.1], "rotate": [0.1, 0, 0.2, 0.97]}]},
               {"rect": {"center": [0.1, 0.1, 0.3], "size": [0.3, 0.15], "normal": [1, 0, 0]}, "speed": 0.5, "from": 0.2}],
  "drains": [{"name": "plug", "box": {"min": [0, 0, 0], "max": [0.2, 0.1, 0.6]}, "from": 0.1}],
  "probes": [{"name": "in", "flow": "tap"}, {"name": "out", "flow": "plug"}]
})";

TEST_F(CheckpointTest, ResumedRunOfFlowsEqualsUninterruptedRun) {
  folder.write("dam.json", kFlows);
  figures({"--frames", "30", "--stats", "whole.json"});
  figures({"--frames", "14", "--checkpoint", "run.rill"});
  figures({"--frames", "16", "--resume", "run.rill", "--stats", "rest.json"});
  const auto whole = frames("whole.json"), rest = frames("rest.json");
  EXPECT_EQ(rest, std::vector<Json>(whole.begin() + 14, whole.end())) << "all figures, flows and the ledger, bitwise";
  for (const Json& frame : whole) {
    const Json& ledger = frame["fluids"][0];
    const auto count = [&](const char* key) { return ledger[key].get<int64_t>(); };
    EXPECT_EQ(count("filled") + count("emitted"), count("particles") + count("drained") + count("left") + count("inactive"));
    EXPECT_EQ(ledger["particles"], frame["particles"]);
  }
  const Json& end = whole.back()["fluids"][0];
  for (const char* key : {"emitted", "drained", "left"}) EXPECT_GT(end[key], 10) << key;
  EXPECT_NEAR(whole.back()["probes"]["in"]["volume"].get<double>(), 0.2 * 29 / 60, 0.006);
}

TEST_F(CheckpointTest, RejectsDamagedFlows) {
  folder.write("dam.json", kFlows);
  figures({"--frames", "8", "--checkpoint", "run.rill"});
  const auto good = offline::loadCheckpoint(folder / "run.rill");
  ASSERT_TRUE(good);
  const auto refused = [&](const auto& change, const std::string& message) { expectDamageRefused(*good, change, message); };
  const auto nan = std::bit_cast<uint32_t>(std::numeric_limits<float>::quiet_NaN());
  const size_t emitter = sizeof(FlowRecord) / 4;
  refused([&](FluidSnapshot& s) { s.flows.pop_back(); }, "flows has ");
  refused([&](FluidSnapshot& s) { s.flows.clear(); }, "flows has 0 entries; expected ");
  refused([&](FluidSnapshot& s) { s.flows[offsetof(FlowRecord, nextId) / 4] = 0; }, "the id of its next particle is 0");
  refused([&](FluidSnapshot& s) { s.flows[offsetof(FlowRecord, blockedHigh) / 4] = nan; }, "flows has a blocked time");
  refused([&](FluidSnapshot& s) { s.flows[emitter + offsetof(EmitterRecord, rate) / 4] = nan; }, "emitters[0] has a state");
  refused([&](FluidSnapshot& s) { s.flows[emitter + offsetof(EmitterRecord, due) / 4] = 2000000; }, "emitters[0] has a state");
}

TEST_F(CheckpointTest, RejectsChangedParticleFile) {
  const auto ply = [](double x) {
    return "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0.5 0.5 0.5\n" +
           std::to_string(x) + " 0.7 0.7\n";
  };
  folder.write("two.ply", ply(0.7));
  folder.write("dam.json", R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {}, "fill": [{"particles": {"file": "two.ply"}}]})");
  figures({"--frames", "2", "--checkpoint", "run.rill"});
  figures({"--frames", "1", "--resume", "run.rill"});
  folder.write("two.ply", ply(0.71));
  expectRefused({"--frames", "1", "--resume", "run.rill"}, {"the initial particles differ"});
}

TEST_F(CheckpointTest, ResumesEmptyScenes) {
  folder.write("dam.json", R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {}})");
  figures({"--frames", "2", "--checkpoint", "run.rill"});
  figures({"--frames", "1", "--resume", "run.rill", "--stats", "rest.json"});
  EXPECT_EQ(frames("rest.json")[0]["time_s"], 2.0 / 60);
}

TEST_F(CheckpointTest, ResumesInLibrary) {
  auto scene = loadScene(folder / "dam.json");
  ASSERT_TRUE(scene);
  auto whole = offline::Simulation::open(*scene);
  ASSERT_TRUE(whole);
  ASSERT_TRUE(whole->advance(0.02));
  const auto taken = whole->checkpoint();
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_EQ(taken->time_s, 0.02);
  offline::Options options;
  options.validation = true;
  auto rest = offline::Simulation::resume(*scene, *taken, options);
  ASSERT_TRUE(rest) << rest.error().message;
  EXPECT_EQ(rest->time(), 0.02);
  EXPECT_EQ(rest->stats()->stateHash, whole->stats()->stateHash);
  for (offline::Simulation* each : {&*whole, &*rest}) ASSERT_TRUE(each->advance(0.03));
  EXPECT_EQ(rest->stats()->stateHash, whole->stats()->stateHash);
  EXPECT_TRUE(rest->warnings().empty());
  const auto again = rest->checkpoint();
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *whole->checkpoint());
  for (const std::string& message : rest->takeValidationMessages()) ADD_FAILURE() << message;

  offline::Checkpoint other = *taken;
  other.driver = "another driver";
  const auto warned = offline::Simulation::resume(*scene, other, {});
  ASSERT_TRUE(warned);
  ASSERT_EQ(warned->warnings().size(), 1u);
  EXPECT_NE(warned->warnings()[0].find("another driver"), std::string::npos);
}

}  // namespace checkpoint_test
}  // namespace rill::test
