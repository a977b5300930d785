// What a checkpoint holds of bodies, probes, emitters and drains: resumed runs go on with it, and damage to it is refused.
#include <bit>
#include <limits>

#include "programs/checkpoint_fixture.hpp"
#include "shared/body_records.h"
#include "shared/flow_records.h"
#include "shared/pressure_probe.h"
#include "shared/solid_records.h"
#include "support/tetrahedron_files.hpp"

namespace rill::test {
namespace checkpoint_test {

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

}  // namespace checkpoint_test
}  // namespace rill::test
