// Culling of passes, and its reports.
#include "graph_fixture.hpp"

namespace rill::test {
namespace {

using Culling = GraphTest;

TEST_F(Culling, UnusedPassAndItsInputsAreCulled) {
  const BufferRef a = write("make a", graph.create("a", {64}));
  const BufferRef b = readWrite("make b", a, Use::ComputeRead, graph.create("b", {64}));
  (void)b;
  compile();
  EXPECT_FALSE(alive(0));
  EXPECT_FALSE(alive(1));
  EXPECT_TRUE(implOf(graph).plans[0].placements.empty()) << "a culled pass needs no memory";
  ASSERT_EQ(graph.report().size(), 2u);
  EXPECT_TRUE(graph.report()[1].culled);
  EXPECT_EQ(graph.report()[1].reason, "nothing reads 'b'");
}

TEST_F(Culling, ImportWritesSideEffectsAndReadbacksAreRoots) {
  const BufferRef a = write("make a", graph.create("a", {64}));
  (void)readWrite("store", a, Use::ComputeRead, import("out"));
  const BufferRef b = write("make b", graph.create("b", {64}));
  read("look", b);
  const BufferRef c = write("make c", graph.create("c", {64}));
  (void)graph.readback(c);
  compile();
  for (size_t i = 0; i < implOf(graph).passes.size(); ++i) EXPECT_TRUE(alive(i)) << i;
}

TEST_F(Culling, ReaderWithoutOutputIsCulledWithItsInput) {
  const BufferRef a = write("make a", graph.create("a", {64}));
  read("look", a, Use::ComputeRead, false);
  compile();
  EXPECT_FALSE(alive(0));
  EXPECT_FALSE(alive(1));
  EXPECT_EQ(graph.report()[1].reason, "it writes nothing");
}

TEST_F(Culling, DiscardedResultIsCulledKeptResultIsNot) {
  BufferRef out = import("out");
  out = write("first", out);
  out = write("second", out, Use::ComputeWrite, true);
  out = write("third", out);
  compile();
  EXPECT_FALSE(alive(0)) << "the second discards it";
  EXPECT_TRUE(alive(1)) << "the third keeps it";
  EXPECT_TRUE(alive(2));
}

TEST_F(Culling, ReportSumsRunsAndListsSkippedPasses) {
  BufferRef out = import("out");
  for (int i = 0; i < 3; ++i) out = write("step", out);
  graph.skipped("viscosity", "fluid.viscosity is 0");
  compile();
  ASSERT_EQ(graph.report().size(), 2u);
  EXPECT_EQ(graph.report()[0].name, "step");
  EXPECT_EQ(graph.report()[0].runs, 3u);
  EXPECT_EQ(graph.report()[1].name, "viscosity");
  EXPECT_EQ(graph.report()[1].reason, "fluid.viscosity is 0");
  EXPECT_FALSE(graph.report()[1].culled);
}

TEST_F(Culling, DotAndJsonShowCullReason) {
  (void)write("make \"a\"", graph.create("a", {64}));
  (void)write("store", import("out"));
  compile();
  EXPECT_NE(graph.dot().find("make \\\"a\\\"\\nculled: nothing reads 'a'\", style=dashed"), std::string::npos) << graph.dot();
  EXPECT_NE(graph.json().find("\"reason\":\"nothing reads 'a'\""), std::string::npos) << graph.json();
  EXPECT_NE(graph.json().find("\"name\":\"store\""), std::string::npos);
}

TEST_F(Culling, EmptyFrameCompiles) {
  compile();
  EXPECT_TRUE(graph.report().empty());
  EXPECT_EQ(graph.transientBytes(), 0u);
}

}  // namespace
}  // namespace rill::test
