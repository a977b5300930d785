// What the host hears of passes that the device switches on and off.
#include <algorithm>
#include <map>

#include "fluid/rig.hpp"

namespace rill::test {
namespace {

class PassRunsTest : public FluidTest {};

TEST_F(PassRunsTest, OfEveryPassThatCanBeEmpty) {
  Trial t = trial();
  t.x = block({8, 8, 8}, t.d(), {0, 0.5, 0}, 0.1);
  setWalls(t, {1, 1, 1});
  t.scene.solids = {ball({0.5, 0.1, 0.5}, 0.1)};
  t.scene.fluid.viscosity = 0.02;
  t.scene.fluid.vorticity = 0.1;
  t.scene.solver.iterations = 3;
  auto run = start(t);
  std::map<std::string, uint64_t> ran;
  bool resume = false, leftOut = false;
  do {
    Graph graph;
    run->fluid().addTo(graph, {.advance_s = 0.05, .resume = resume, .substeps = 12});
    runGraph(graph);
    if (HasFatalFailure()) return;
    for (const FluidPassRuns& pass : run->fluid().passRuns()) {
      EXPECT_LE(pass.ran, pass.of) << pass.name;
      leftOut = leftOut || pass.ran < pass.of;
      ran[std::string(pass.name)] += pass.ran;
      uint64_t recorded = 0;
      for (const PassReport& report : graph.report())
        if (report.reason.empty() && (pass.name.ends_with('/') ? report.name.starts_with(pass.name) : report.name == pass.name))
          recorded += report.runs;
      const bool declared = pass.name != "move solids";
      EXPECT_EQ(recorded > 0, declared) << pass.name;
      EXPECT_EQ(recorded % pass.of, 0u) << pass.name;
    }
    resume = true;
  } while (run->progress().time_left_s > 0);
  const FluidProgress& p = run->progress();
  EXPECT_TRUE(leftOut) << "the list is not built at each of the places where it could be";
  EXPECT_GT(p.list_builds, 1u);
  EXPECT_EQ(ran["build list"], p.list_builds + 1u) << "and once at the start";
  EXPECT_EQ(ran["sort/"], p.list_builds + 1u);
  for (const char* each : {"correct", "collide", "collide again", "viscosity", "curl", "confine"}) EXPECT_EQ(ran[each], p.substeps) << each;
  for (const char* each : {"density", "walls and solids"}) EXPECT_EQ(ran[each], p.iterations) << each;
  EXPECT_EQ(ran["iterate"], p.iterations - p.substeps);
}

TEST_F(PassRunsTest, OfOneFrameEach) {
  Trial t = trial();
  t.x = block({6, 6, 6}, t.d());
  auto run = start(t);
  run->substeps(5);
  for (int frame = 0; frame < 3; ++frame) {
    run->substeps(4);
    const auto passes = run->fluid().passRuns();
    const auto correct = std::ranges::find(passes, "correct", &FluidPassRuns::name);
    ASSERT_NE(correct, passes.end());
    EXPECT_EQ(correct->ran, 4u);
  }
  run->stats();
  for (const FluidPassRuns& pass : run->fluid().passRuns()) {
    EXPECT_EQ(pass.name == "sort/" ? 1u : 0u, pass.ran) << pass.name << ": figures sort for themselves, and advance nothing";
  }
}

}  // namespace
}  // namespace rill::test
