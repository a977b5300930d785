// Declaration errors are reported in release builds too, with pass and resource in the message.
#include "graph_fixture.hpp"

namespace rill::test {
namespace {

using DeclarationErrors = GraphTest;
using ::testing::Test;

#define EXPECT_MESSAGE(text) EXPECT_EQ(compileError(), text)

TEST_F(DeclarationErrors, RejectsReadOfConsumedVersion) {
  const BufferRef old = import("velocities");
  (void)write("integrate", old);
  read("advect", old);
  EXPECT_MESSAGE("pass 'advect' reads version 0 of 'velocities', which a later write consumed; expected version 1");
}

TEST_F(DeclarationErrors, RejectsWriteToConsumedVersion) {
  const BufferRef old = import("velocities");
  (void)write("integrate", old);
  (void)write("damp", old);
  EXPECT_MESSAGE("pass 'damp' writes version 0 of 'velocities', which a later write consumed; expected version 1");
}

TEST_F(DeclarationErrors, RejectsRefOfEarlierFrame) {
  const BufferRef old = import("velocities");
  graph.reset();
  (void)import("velocities");
  read("advect", old);
  EXPECT_MESSAGE("pass 'advect' reads a buffer through a ref of another graph or an earlier frame; refs are valid until Graph::reset()");
}

TEST_F(DeclarationErrors, RejectsRefOfOtherGraph) {
  Graph other;
  const BufferRef foreign = other.create("foreign", {64});
  (void)import("velocities");
  (void)write("advect", foreign);
  EXPECT_MESSAGE("pass 'advect' writes a buffer through a ref of another graph or an earlier frame; refs are valid until Graph::reset()");
}

TEST_F(DeclarationErrors, RejectsEmptyRef) {
  read("advect", BufferRef{});
  EXPECT_MESSAGE("pass 'advect' reads a buffer through an empty ref");
}

TEST_F(DeclarationErrors, RejectsReadOfUndefinedContent) {
  read("advect", graph.create("scratch", {64}));
  EXPECT_MESSAGE("pass 'advect' reads 'scratch', whose content is undefined; write it in an earlier pass");
}

TEST_F(DeclarationErrors, RejectsReadbackOfUndefinedContent) {
  (void)graph.readback(graph.create("scratch", {64}));
  EXPECT_MESSAGE("pass 'readback' reads 'scratch', whose content is undefined; write it in an earlier pass");
}

TEST_F(DeclarationErrors, RejectsAtomicsOnUndefinedContent) {
  (void)write("count", graph.create("counter", {64}), Use::ComputeAtomic);
  EXPECT_MESSAGE("pass 'count' uses atomics on 'counter', whose content is undefined; fill it first");
}

TEST_F(DeclarationErrors, RejectsReadAndWriteInOnePass) {
  const BufferRef a = import("a");
  (void)readWrite("blur", a, Use::ComputeRead, a);
  EXPECT_MESSAGE("pass 'blur' uses 'a' more than once, including a write; declare only the write (it may read as well), or use two passes");
}

TEST_F(DeclarationErrors, RejectsReadOfOwnOutput) {
  graph.pass("blur", [&](Pass& pass) {
    const BufferRef out = pass.write(import("a"), Use::ComputeWrite);
    pass.read(out, Use::Indirect);
    return [](Commands&) {};
  });
  EXPECT_MESSAGE("pass 'blur' reads and writes 'a'; declare only the write (it may read as well), or use two passes");
}

TEST_F(DeclarationErrors, RejectsReadUsesForWritesAndViceVersa) {
  read("advect", import("a"), Use::ComputeWrite);
  EXPECT_MESSAGE("pass 'advect' reads 'a' with Use::ComputeWrite, which is not a read use");
  graph.reset();
  (void)write("advect", import("a"), Use::Indirect);
  EXPECT_MESSAGE("pass 'advect' writes 'a' with Use::Indirect, which is not a write use");
}

TEST_F(DeclarationErrors, RejectsInvalidBufferSizes) {
  (void)graph.create("nothing", {0});
  EXPECT_MESSAGE("buffer 'nothing': size is 0");
  graph.reset();
  (void)graph.create("list", {kMaxBufferBytes + 1});
  EXPECT_MESSAGE("buffer 'list' of 4294967297 bytes; expected at most 4294967296");
}

TEST_F(DeclarationErrors, RejectsOverlappingImportsWithWrites) {
  const BufferRef a = graph.import("a", {fakeBuffer(1), 0, 512});
  const BufferRef b = graph.import("b", {fakeBuffer(1), 256, 512});
  read("look", a);
  read("look", b);
  compile();
  (void)write("spoil", b);
  EXPECT_MESSAGE("imports 'a' and 'b' overlap in the same VkBuffer and one is written; import the memory once");
}

TEST_F(DeclarationErrors, RejectsNullImport) {
  (void)graph.import("a", {VK_NULL_HANDLE, 0, 512});
  EXPECT_MESSAGE("import 'a': null handle, expected a VkBuffer");
}

TEST_F(DeclarationErrors, RejectsMismatchedBindings) {
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
    return compileError();
  };
  EXPECT_EQ(declare([&](Pass& p, BufferRef in, BufferRef, BufferRef) { (void)p.kernel(&fake.pipeline, {in}); }),
            "pass 'sort', shader 'fake': 1 resources; expected 2");
  EXPECT_EQ(declare([&](Pass& p, BufferRef in, BufferRef out, BufferRef) {
              (void)p.kernel(&fake.pipeline, {in, out});
            }),
            "pass 'sort', shader 'fake': binding 0 is a texel buffer, which matches no declared use of 'in'");
  EXPECT_EQ(declare([&](Pass& p, BufferRef, BufferRef out, BufferRef other) {
              (void)p.kernel(&fake.pipeline, {other, out});
            }),
            "pass 'sort', shader 'fake': binding 0 is 'other' in a version that the pass does not declare");
}

TEST_F(DeclarationErrors, RejectsInvalidUseValues) {
  const auto after = [&](auto&& declare) {
    graph.reset();
    declare();
    return compileError();
  };
  EXPECT_EQ(after([&] { (void)import("a", Use(99)); }), "import 'a': invalid Use value 99");
  EXPECT_EQ(after([&] { (void)import("a", Use::Nothing, Use(200)); }), "import 'a': invalid Use value 200");
  EXPECT_EQ(after([&] { read("look", import("a"), Use(99)); }), "pass 'look' reads 'a' with invalid Use value 99");
  EXPECT_EQ(after([&] { (void)write("change", import("a"), Use(99)); }), "pass 'change' writes 'a' with invalid Use value 99");
}

TEST_F(DeclarationErrors, RejectsKernelWithNullPipeline) {
  const auto declare = [&](auto pipeline) {
    graph.reset();
    const BufferRef in = import("in");
    graph.pass("sort", [&](Pass& pass) {
      pass.read(in, Use::ComputeRead);
      (void)pass.kernel(pipeline, {in});
      return [](Commands&) {};
    });
    return compileError();
  };
  const std::string expected = "pass 'sort' declares a kernel with a null pipeline";
  EXPECT_EQ(declare(static_cast<const ComputePipeline*>(nullptr)), expected);
  EXPECT_EQ(declare(static_cast<const GraphicsPipeline*>(nullptr)), expected);
}

TEST_F(DeclarationErrors, ReportsFirstErrorUntilReset) {
  const BufferRef bad = write("first", graph.create("a", {64}), Use::Indirect);
  read("second", bad);
  EXPECT_NE(compileError().find("'first'"), std::string::npos);
  graph.reset();
  (void)write("good", import("b"));
  compile();
}

}  // namespace
}  // namespace rill::test
