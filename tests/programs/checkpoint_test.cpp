// rill-capture --checkpoint and --resume: a resumed run equals one without interruption. With bodies and flows: checkpoint_state_test.cpp.
#include "programs/checkpoint_fixture.hpp"

namespace rill::test {
namespace checkpoint_test {

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
