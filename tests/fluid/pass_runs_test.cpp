// What the host hears of passes that the device switches on and off.
#include <algorithm>
#include <map>

#include "fluid/rig.hpp"

namespace rill::test {
namespace pass_runs_test {

class PassRunsTest : public FluidTest {
 protected:
  /// Advances in pieces; what ran, by name, added up. Held against the graph's report: each name is a pass of it, recorded so many times.
  std::map<std::string, uint64_t> ranIn(Run& run, double seconds) {
    std::map<std::string, uint64_t> ran;
    bool resume = false;
    do {
      Graph graph;
      run.fluid().addTo(graph, {.advance_s = seconds, .resume = resume, .substeps = 12});
      runGraph(graph);
      if (HasFatalFailure()) return ran;
      for (const FluidPassRuns& pass : run.fluid().passRuns()) {
        EXPECT_LE(pass.executed, pass.recorded) << pass.name;
        ran[std::string(pass.name)] += pass.executed;
        uint64_t recorded = 0;
        for (const PassReport& report : graph.report())
          if (report.reason.empty() && (pass.name.ends_with('/') ? report.name.starts_with(pass.name) : report.name == pass.name))
            recorded += report.runs;
        EXPECT_GT(recorded, 0u) << pass.name;
        EXPECT_EQ(recorded % pass.recorded, 0u) << pass.name;
      }
      resume = true;
    } while (run.progress().timeLeft_s > 0);
    return ran;
  }
};

Trial shaken() {
  Trial t = trial();
  t.x = block({8, 8, 8}, t.d(), {0, 0.5, 0}, 0.1);
  setWalls(t, {1, 1, 1});
  t.scene.solids = {ball({0.5, 0.1, 0.5}, 0.1)};
  return t;
}

TEST_F(PassRunsTest, CountsPassesThatMayBeEmpty) {
  Trial t = shaken();
  t.scene.fluid.viscosity = 0.02;
  t.scene.fluid.vorticity = 0.1;
  t.scene.solver.iterations = 3;
  auto run = start(t);
  const auto ran = ranIn(*run, 0.1);
  const FluidProgress& p = run->progress();
  EXPECT_GT(p.listBuilds, 1u);
  EXPECT_EQ(ran.at("build list"), p.listBuilds + 1u) << "and once at the start";
  EXPECT_EQ(ran.at("sort/"), p.listBuilds + 1u);
  for (const char* each :
       {"correct", "collide", "predict after forces", "predict at solids", "viscosity", "viscosity start", "curl", "confine"})
    EXPECT_EQ(ran.at(each), p.substeps) << each;
  for (const char* each : {"density", "density of solids"}) EXPECT_EQ(ran.at(each), p.iterations) << each;
  EXPECT_EQ(ran.at("iterate"), p.iterations - p.substeps);
  EXPECT_EQ(ran.count("move solids"), 0u) << "no solid moves";
}

TEST_F(PassRunsTest, CountsPassesOfABlock) {
  Trial t = shaken();
  t.scene.solver.artificial_viscosity = 0.1;
  auto run = start(t);
  const auto ran = ranIn(*run, 0.05);
  const uint64_t damped = ran.at("noise damping");
  EXPECT_GE(damped, 1u);
  EXPECT_LT(damped, run->progress().substeps) << "blocks have several substeps";
  for (const char* each : {"velocity noise", "predict after forces", "predict at solids"}) EXPECT_EQ(ran.at(each), damped) << each;
  EXPECT_EQ(ran.count("viscosity"), 0u);
}

TEST_F(PassRunsTest, SumsFramesSinceTheLastQuery) {
  Trial t = trial();
  t.x = block({6, 6, 6}, t.d());
  auto run = start(t);
  run->substeps(5);
  const auto corrections = [&] {
    const auto passes = run->fluid().passRuns();
    const auto correct = std::ranges::find(passes, "correct", &FluidPassRuns::name);
    EXPECT_NE(correct, passes.end());
    return correct == passes.end() ? FluidPassRuns{} : *correct;
  };
  for (int frame = 0; frame < 3; ++frame) {
    run->substeps(4);
    EXPECT_EQ(corrections().executed, 4u);
  }
  for (int frame = 0; frame < 3; ++frame) {  // frames whose runs are not read
    Graph graph;
    run->fluid().addTo(graph, {.advance_s = 4 * t.step, .substeps = 12});
    runGraph(graph);
  }
  run->substeps(4);
  EXPECT_EQ(corrections().executed, 16u);
  EXPECT_GE(corrections().recorded, 16u);
  run->stats();
  for (const FluidPassRuns& pass : run->fluid().passRuns())
    EXPECT_EQ(pass.name == "sort/" ? 1u : 0u, pass.executed) << pass.name << ": figures sort for themselves, and advance nothing";
}

// Two rebuilds behind each other, of which the second has nothing to do: before the first advance, and in a piece of an advance that has
// none yet.
TEST_F(PassRunsTest, SecondRebuildChangesNothing) {
  for (bool looked : {false, true}) {
    Trial t = shaken();
    auto run = start(t), plain = start(t);
    if (looked) run->read({});
    run->read({.resume = true, .substeps = 6});
    run->advance(0.02);
    plain->advance(0.02);
    EXPECT_EQ(run->snapshot(), plain->snapshot());
  }
}

}  // namespace pass_runs_test
}  // namespace rill::test
