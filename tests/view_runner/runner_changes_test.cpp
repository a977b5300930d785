// Changes of the viewer's scene while it runs: live, with a restart, saved, and by its file.
#include <algorithm>

#include "view/session.hpp"
#include "view_runner/runner_fixture.hpp"

namespace rill::view {
namespace runner_test {

TEST_F(ViewRunnerTest, LiveChangeContinuesFromCurrentState) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session) << session.error().message;
  Session& s = **session;
  for (int k = 0; k < 6; ++k) ASSERT_TRUE(s.runner().step());
  const auto before = s.runner().measure();
  ASSERT_TRUE(before);
  ASSERT_TRUE(s.isLive("gravity"));
  const auto changed = s.change({"gravity", "[4, 0, 0]"});
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(s.runner().steps(), 6u);
  const auto at = s.runner().measure();
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->time_s, before->time_s, 1e-6);
  EXPECT_NEAR(at->kinetic_J, before->kinetic_J, 1e-6 * before->kinetic_J + 1e-9) << "nothing has moved";
  ASSERT_TRUE(s.runner().step());
  const auto after = s.runner().measure();
  ASSERT_TRUE(after);
  // 75 kg in free fall along x for a step: 5 kg m/s more, but for what the walls take.
  const double mass = 1000 * 0.05 * 0.05 * 0.05 * 600;
  const double gained = after->momentum[0] - at->momentum[0], lostDown = after->momentum[1] - at->momentum[1];
  EXPECT_GT(gained, 0.5 * mass * 4 / 60);
  EXPECT_GT(lostDown, -0.2 * mass * 9.81 / 60) << "nothing pulls down any more";

  ASSERT_TRUE(s.change({"fluid.viscosity", "20"}));
  ASSERT_TRUE(s.change({"solver.iterations", "2"}));
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(s.runner().step());
  EXPECT_EQ(s.runner().steps(), 12u);
  EXPECT_EQ(s.scene().fluid.viscosity, 20);
  const auto end = s.runner().measure();
  ASSERT_TRUE(end);
  EXPECT_EQ(end->nonFinite, 0u);
  EXPECT_EQ(end->outside, 0u);
  EXPECT_LT(end->densityErrorMean, 0.01);
}

// Mud stiffens and flows again; what the passes of shear need is not in the state before.
TEST_F(ViewRunnerTest, YieldStressChangesWhileFluidFlows) {
  std::string text = kDam;
  auto session = Session::open(context(), folder.write("mud.json", text.replace(text.find("0.1"), 3, "0.2")));
  ASSERT_TRUE(session) << session.error().message;
  Session& s = **session;
  std::ptrdiff_t shears = 0;  // passes, in the last step
  const auto kineticAfter = [&](int steps) {
    for (int k = 0; k < steps; ++k) EXPECT_TRUE(s.runner().step());
    shears = std::ranges::count(s.runner().fluid().passRuns(), "viscosity by shear", &FluidPassRuns::name);
    const auto stats = s.runner().measure();
    EXPECT_TRUE(stats);
    if (!stats) return 0.0;
    EXPECT_EQ(stats->nonFinite + stats->outside, 0u);
    return stats->kinetic_J;
  };
  const double flows = kineticAfter(6);
  ASSERT_TRUE(s.isLive("fluid.yield_stress"));
  ASSERT_TRUE(s.change({"fluid.yield_stress", "20000"}));
  const double stands = kineticAfter(6);
  EXPECT_EQ(shears, 1);
  EXPECT_LT(stands, 0.01 * flows);
  ASSERT_TRUE(s.reset("fluid.yield_stress"));
  EXPECT_GT(kineticAfter(6), 10 * stands);
  EXPECT_EQ(shears, 0);
  EXPECT_EQ(s.runner().steps(), 18u);

  EXPECT_FALSE(s.isLive("fluid.surface_tension")) << "lists of neighbors are longer with it";
  ASSERT_TRUE(s.change({"fluid.surface_tension", "10"}));
  EXPECT_EQ(s.runner().steps(), 0u);
  ASSERT_TRUE(s.isLive("fluid.contact_angle"));
  EXPECT_GT(kineticAfter(2), 0);
  ASSERT_TRUE(s.change({"fluid.contact_angle", "20"}));
  EXPECT_GT(kineticAfter(2), 0);
  EXPECT_EQ(s.runner().steps(), 4u);
}

TEST_F(ViewRunnerTest, InvalidChangeHasNoEffect) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  Session& s = **session;
  ASSERT_TRUE(s.runner().step());
  for (const Override& bad :
       {Override{"fluid.viscosity", "-1"}, {"fluid.spacing", "0"}, {"solver.nonsense", "1"}, {"fluid.spacing", "1e-5"}}) {
    const auto changed = s.change(bad);
    ASSERT_FALSE(changed) << bad.key;
    EXPECT_FALSE(s.isChanged(bad.key));
    EXPECT_EQ(s.runner().steps(), 1u);
  }
  EXPECT_TRUE(s.runner().step());
}

TEST_F(ViewRunnerTest, OtherChangesRestartAndResetRestores) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  Session& s = **session;
  ASSERT_TRUE(s.runner().step());
  EXPECT_FALSE(s.isLive("fluid.spacing"));
  ASSERT_TRUE(s.change({"fluid.spacing", "0.1"}));
  EXPECT_EQ(s.runner().steps(), 0u);
  EXPECT_EQ(s.runner().fluid().count(), 75u);
  EXPECT_TRUE(s.isChanged("fluid.spacing"));
  ASSERT_TRUE(s.reset("fluid.spacing"));
  EXPECT_EQ(s.runner().fluid().count(), 600u);
  EXPECT_TRUE(s.changes().empty());
}

TEST_F(ViewRunnerTest, SavedSceneContainsChanges) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  ASSERT_TRUE((*session)->change({"fluid.viscosity", "0.25"}));
  ASSERT_TRUE((*session)->change({"solver.time_step", "\"auto\""}));
  ASSERT_TRUE((*session)->change({"look.preset", "milk"}));
  const auto text = (*session)->text(folder.path());
  ASSERT_TRUE(text) << text.error().message;
  const auto saved = loadScene(folder.write("saved.json", *text));
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->fluid.viscosity, 0.25);
  EXPECT_EQ(saved->look.preset, "milk");
  EXPECT_FALSE(saved->solver.time_step);
  EXPECT_EQ(saved->fluid.spacing, 0.05);
}

TEST_F(ViewRunnerTest, SavedSceneHasRelativePaths) {
  const test::TemporaryFolder elsewhere;
  folder.write("sky.hdr", "x");
  folder.write("water.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n.5 .5 .1\n");
  elsewhere.write("other.hdr", "x");
  const auto named = folder.write("named.json", R"({
    "rill": "0.1", "domain": {"min": [0, 0, 0], "max": [1, 1, 0.3]}, "fluid": {"spacing": 0.05},
    "fill": [{"particles": {"file": "water.ply"}}], "look": {"environment": "sky.hdr"}
  })");
  auto session = Session::open(context(), named);
  ASSERT_TRUE(session) << session.error().message;
  const auto saved = [&] {
    const auto text = (*session)->text(elsewhere.path());
    EXPECT_TRUE(text) << text.error().message;
    const auto scene = loadScene(elsewhere.write("saved.json", *text));
    EXPECT_TRUE(scene) << scene.error().message;
    return *scene;
  };
  EXPECT_TRUE(std::filesystem::equivalent(saved().look.environment, folder / "sky.hdr"));
  EXPECT_TRUE(std::filesystem::equivalent(std::get<ParticleFile>(saved().fill[0].shape).file, folder / "water.ply"));
  const auto fromHere = std::filesystem::relative(elsewhere / "other.hdr");
  ASSERT_TRUE((*session)->change({"look.environment", fromHere.string()}));
  EXPECT_TRUE(std::filesystem::equivalent(saved().look.environment, elsewhere / "other.hdr"));
}

TEST_F(ViewRunnerTest, ReloadsChangedFileAndKeepsSceneWhenInvalid) {
  auto session = Session::open(context(), file);
  ASSERT_TRUE(session);
  Session& s = **session;
  EXPECT_FALSE(s.fileChanged(1));
  folder.write("dam.json", "{ broken");
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(3));
  EXPECT_FALSE(s.fileChanged(1.2)) << "not asked more than twice a second";
  EXPECT_TRUE(s.fileChanged(2));
  const auto again = s.reload();
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("dam.json"), std::string::npos);
  EXPECT_FALSE(s.fileChanged(3)) << "reported once";
  EXPECT_TRUE(s.runner().step());
  // What is done to the scene meanwhile goes on from the text that it was read from.
  EXPECT_TRUE(s.change({"fluid.viscosity", "0.5"}));
  EXPECT_TRUE(s.restart());
  EXPECT_EQ(s.scene().fluid.viscosity, 0.5);
  folder.write("dam.json", std::string(kDam).replace(std::string(kDam).find("0.05"), 4, "0.10"));
  ASSERT_TRUE(s.reload());
  EXPECT_EQ(s.scene().fluid.spacing, 0.1);
  EXPECT_EQ(s.scene().fluid.viscosity, 0.5);
}

}  // namespace runner_test
}  // namespace rill::view
