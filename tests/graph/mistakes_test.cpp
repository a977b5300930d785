// Mistakes in a declaration are errors in release builds too, with the pass and the resource in the message.
#include "graph_fixture.hpp"

namespace rill::test {
namespace {

using Mistakes = GraphTest;
using ::testing::Test;

#define EXPECT_MESSAGE(text) EXPECT_EQ(mistake(), text)

TEST_F(Mistakes, ReadingAConsumedVersion) {
  const BufferRef old = import("velocities");
  (void)write("integrate", old);
  read("advect", old);
  EXPECT_MESSAGE("pass 'advect' reads version 0 of 'velocities', which a later write consumed: the latest is version 1");
}

TEST_F(Mistakes, WritingAConsumedVersion) {
  const BufferRef old = import("velocities");
  (void)write("integrate", old);
  (void)write("damp", old);
  EXPECT_MESSAGE("pass 'damp' writes version 0 of 'velocities', which a later write consumed: the latest is version 1");
}

TEST_F(Mistakes, ARefOfAnEarlierFrame) {
  const BufferRef old = import("velocities");
  graph.reset();
  (void)import("velocities");
  read("advect", old);
  EXPECT_MESSAGE("pass 'advect' reads a buffer of another graph or of an earlier frame: refs do not outlive Graph::reset()");
}

TEST_F(Mistakes, ARefOfAnotherGraph) {
  Graph other;
  const BufferRef foreign = other.create("foreign", {64});
  (void)import("velocities");
  (void)write("advect", foreign);
  EXPECT_MESSAGE("pass 'advect' writes a buffer of another graph or of an earlier frame: refs do not outlive Graph::reset()");
}

TEST_F(Mistakes, AnEmptyRef) {
  read("advect", BufferRef{});
  EXPECT_MESSAGE("pass 'advect' reads a buffer that was never made (an empty ref)");
}

TEST_F(Mistakes, ReadingWhatNobodyWrote) {
  read("advect", graph.create("scratch", {64}));
  EXPECT_MESSAGE("pass 'advect' reads 'scratch', which no pass has written");
}

TEST_F(Mistakes, ReadingBackWhatNobodyWrote) {
  (void)graph.readback(graph.create("scratch", {64}));
  EXPECT_MESSAGE("pass 'readback' reads 'scratch', which no pass has written");
}

TEST_F(Mistakes, AtomicsOnUndefinedContent) {
  (void)write("count", graph.create("counter", {64}), Use::ComputeAtomic);
  EXPECT_MESSAGE("pass 'count' does atomics on 'counter', whose content is undefined: fill it first");
}

TEST_F(Mistakes, ReadAndWriteInOnePass) {
  const BufferRef a = import("a");
  (void)readWrite("blur", a, Use::ComputeRead, a);
  EXPECT_MESSAGE("pass 'blur' uses 'a' twice, once to write: declare the write alone (it may read as well), or make two passes");
}

TEST_F(Mistakes, ReadingTheOwnResult) {
  graph.pass("blur", [&](Pass& pass) {
    const BufferRef out = pass.write(import("a"), Use::ComputeWrite);
    pass.read(out, Use::Indirect);
    return [](Commands&) {};
  });
  EXPECT_MESSAGE("pass 'blur' reads and writes 'a': declare the write alone (it may read as well), or make two passes");
}

TEST_F(Mistakes, UsesThatAreNone) {
  read("advect", import("a"), Use::ComputeWrite);
  EXPECT_MESSAGE("pass 'advect' reads 'a' with Use::ComputeWrite, which is no way for a pass to read");
  graph.reset();
  (void)write("advect", import("a"), Use::Indirect);
  EXPECT_MESSAGE("pass 'advect' writes 'a' with Use::Indirect, which is no way for a pass to write");
}

TEST_F(Mistakes, SizesThatNoBufferHas) {
  (void)graph.create("nothing", {0});
  EXPECT_MESSAGE("buffer 'nothing' has no size");
  graph.reset();
  (void)graph.create("list", {kMaxBufferBytes + 1});
  EXPECT_MESSAGE("buffer 'list' of 134217729 bytes: at most 134217728 are possible");
}

TEST_F(Mistakes, MemoryImportedTwiceAndWritten) {
  const BufferRef a = graph.import("a", {fakeBuffer(1), 0, 512});
  const BufferRef b = graph.import("b", {fakeBuffer(1), 256, 512});
  read("look", a);
  read("look", b);
  compile();
  (void)write("spoil", b);
  EXPECT_MESSAGE("imports 'a' and 'b' overlap in one VkBuffer and one is written: import the memory once");
}

TEST_F(Mistakes, ANullImport) {
  (void)graph.import("a", {VK_NULL_HANDLE, 0, 512});
  EXPECT_MESSAGE("import 'a' has a null VkBuffer");
}

TEST_F(Mistakes, BindingsThatDoNotFit) {
  FakePipeline fake{BindingKind::TexelUint, BindingKind::Storage};
  const auto declare = [&](auto&& bind) {
    graph.reset();
    const BufferRef in = import("in"), out = import("out"), other = import("other");
    graph.pass("sort", [&](Pass& pass) {
      pass.read(in, Use::ComputeRead);
      const BufferRef made = pass.write(out, Use::ComputeWrite);
      bind(pass, in, made, other);
      return [](Commands&) {};
    });
    return mistake();
  };
  EXPECT_EQ(declare([&](Pass& p, BufferRef in, BufferRef, BufferRef) { (void)p.kernel(&fake.pipeline, {in}); }),
            "pass 'sort', shader 'fake': 1 resources were given for its 2 bindings");
  EXPECT_EQ(declare([&](Pass& p, BufferRef in, BufferRef out, BufferRef) {
              (void)p.kernel(&fake.pipeline, {in, out});
            }),
            "pass 'sort', shader 'fake': binding 0 is a texel buffer, which no declared use of 'in' is");
  EXPECT_EQ(declare([&](Pass& p, BufferRef, BufferRef out, BufferRef other) {
              (void)p.kernel(&fake.pipeline, {other, out});
            }),
            "pass 'sort', shader 'fake': binding 0 is 'other' in a version that the pass neither reads nor writes");
}

TEST_F(Mistakes, NumbersThatAreNoUse) {
  const auto after = [&](auto&& declare) {
    graph.reset();
    declare();
    return mistake();
  };
  EXPECT_EQ(after([&] { (void)import("a", Use(99)); }), "import 'a': 99 is no Use");
  EXPECT_EQ(after([&] { (void)import("a", Use::Nothing, Use(200)); }), "import 'a': 200 is no Use");
  EXPECT_EQ(after([&] { read("look", import("a"), Use(99)); }), "pass 'look' reads 'a' with 99, which is no Use");
  EXPECT_EQ(after([&] { (void)write("change", import("a"), Use(99)); }), "pass 'change' writes 'a' with 99, which is no Use");
}

TEST_F(Mistakes, AKernelWithoutAPipeline) {
  const auto declare = [&](auto pipeline) {
    graph.reset();
    const BufferRef in = import("in");
    graph.pass("sort", [&](Pass& pass) {
      pass.read(in, Use::ComputeRead);
      (void)pass.kernel(pipeline, {in});
      return [](Commands&) {};
    });
    return mistake();
  };
  const std::string expected = "pass 'sort' declares a kernel without a pipeline (null)";
  EXPECT_EQ(declare(static_cast<const ComputePipeline*>(nullptr)), expected);
  EXPECT_EQ(declare(static_cast<const GraphicsPipeline*>(nullptr)), expected);
}

TEST_F(Mistakes, TheFirstOneIsReportedAndResetForgetsIt) {
  const BufferRef bad = write("first", graph.create("a", {64}), Use::Indirect);
  read("second", bad);
  EXPECT_NE(mistake().find("'first'"), std::string::npos);
  graph.reset();
  (void)write("good", import("b"));
  compile();
}

}  // namespace
}  // namespace rill::test
