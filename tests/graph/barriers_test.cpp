// The exact barriers of small frames.
#include "graph_fixture.hpp"

namespace rill::test {
namespace {

using Barriers = GraphTest;
constexpr Scope kNoBarrier{};

TEST_F(Barriers, ReadAfterWriteNeedsMemoryBarrierReadAfterReadNone) {
  BufferRef a = write("write", import("a"));
  read("read", a);
  read("again", a);
  read("texel", a, Use::ComputeTexel);
  compile();
  EXPECT_EQ(barrier(0), kNoBarrier);
  EXPECT_EQ(barrier(1), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead}));
  EXPECT_EQ(barrier(2), kNoBarrier);
  EXPECT_EQ(barrier(3), (Scope{kCompute, kStorageWrite, kCompute, kSampled})) << "the write is not visible to another kind of read";
}

TEST_F(Barriers, WriteAfterReadNeedsExecutionBarrierOnly) {
  BufferRef a = write("write", import("a"));
  read("read", a);
  a = write("overwrite", a);
  compile();
  EXPECT_EQ(barrier(2), (Scope{kCompute, 0, kCompute, 0}));
}

TEST_F(Barriers, WriteThatKeepsUnseenContentNeedsMemoryBarrier) {
  BufferRef a = write("write", import("a"));
  read("copy", a, Use::CopySource);
  a = write("add", a);
  compile();
  EXPECT_EQ(barrier(2), (Scope{kCompute | kTransfer, kStorageWrite, kCompute, kStorageRead | kStorageWrite}));
}

TEST_F(Barriers, WriteAfterWriteNeedsMemoryBarrier) {
  BufferRef a = import("a");
  a = write("fill", a, Use::CopyTarget);
  a = write("add", a);
  a = write("add", a);
  compile();
  EXPECT_EQ(barrier(1), (Scope{kTransfer, kTransferWrite, kCompute, kStorageRead | kStorageWrite}));
  EXPECT_EQ(barrier(2), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead | kStorageWrite}));
}

TEST_F(Barriers, AtomicsCommuteOnlyWithAtomics) {
  BufferRef a = import("a");
  a = write("fill", a, Use::CopyTarget);
  a = write("count", a, Use::ComputeAtomic);
  a = write("count", a, Use::ComputeAtomic);
  a = write("count", a, Use::ComputeAtomic);
  read("look", a);
  a = write("count", a, Use::ComputeAtomic);
  a = write("scale", a, Use::ComputeWrite);
  compile();
  EXPECT_EQ(barrier(1), (Scope{kTransfer, kTransferWrite, kCompute, kStorageRead | kStorageWrite}));
  EXPECT_EQ(barrier(2), kNoBarrier);
  EXPECT_EQ(barrier(3), kNoBarrier);
  EXPECT_EQ(barrier(4), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead}));
  EXPECT_EQ(barrier(5), (Scope{kCompute, 0, kCompute, 0}));
  EXPECT_EQ(barrier(6), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead | kStorageWrite}));
}

TEST_F(Barriers, BarrierServesAllCoveredResources) {
  const BufferRef a = write("make a", import("a"));
  const BufferRef b = write("make b", import("b"));
  read("read a", a);
  read("read b", b);
  compile();
  EXPECT_EQ(barrier(2), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead}));
  EXPECT_EQ(barrier(3), kNoBarrier) << "the barrier before 'read a' also covers 'make b'";
}

TEST_F(Barriers, PassHasOneBarrierForAllResources) {
  const BufferRef arguments = write("arguments", import("arguments"));
  const BufferRef filled = write("fill", import("filled"), Use::CopyTarget);
  graph.pass("work", [&](Pass& pass) {
    pass.read(arguments, Use::Indirect);
    pass.read(filled, Use::ComputeRead);
    pass.sideEffect();
    return [](Commands&) {};
  });
  compile();
  EXPECT_EQ(barrier(2), (Scope{kCompute | kTransfer, kStorageWrite | kTransferWrite, kCompute | kIndirect, kStorageRead | kIndirectRead}));
  EXPECT_EQ(implOf(graph).passes[2].barrier.causes.count, 2u);
}

TEST_F(Barriers, ImportsAreSynchronizedBeforeAndAfter) {
  const BufferRef a = import("written", Use::ComputeWrite, Use::Indirect);
  const BufferRef b = import("unknown", Use::Unknown);
  const BufferRef c = import("idle");
  read("read a", a);
  read("read b", b);
  read("read c", c);
  compile();
  EXPECT_EQ(barrier(0), (Scope{kCompute, kStorageWrite, kCompute, kStorageRead}));
  EXPECT_EQ(barrier(1), (Scope{kAll, kMemoryWrite, kCompute, kStorageRead}));
  EXPECT_EQ(barrier(2), kNoBarrier);
  EXPECT_EQ(implOf(graph).finalBarrier.scope, (Scope{kCompute, kStorageWrite, kIndirect, kIndirectRead}));
}

TEST_F(Barriers, WriteToReadImportNeedsExecutionBarrierOnly) {
  (void)write("overwrite", import("a", Use::ComputeRead), Use::ComputeWrite);
  compile();
  EXPECT_EQ(barrier(0), (Scope{kCompute, 0, kCompute, 0}));
}

TEST_F(Barriers, AfterStatesAreReachedWithAllPassesCulled) {
  (void)import("a", Use::CopyTarget, Use::ComputeRead);
  (void)write("useless", graph.create("t", {64}));
  compile();
  EXPECT_FALSE(alive(0));
  EXPECT_EQ(implOf(graph).finalBarrier.scope, (Scope{kTransfer, kTransferWrite, kCompute, kStorageRead}));
}

TEST_F(Barriers, ReadbacksAreVisibleToHost) {
  (void)graph.readback(write("write", import("a")));
  compile();
  EXPECT_EQ(barrier(1), (Scope{kCompute, kStorageWrite, kTransfer, kTransferRead}));
  EXPECT_EQ(implOf(graph).finalBarrier.scope, (Scope{kTransfer, kTransferWrite, kHost, kHostRead}));
}

TEST_F(Barriers, FirstTransientWaitsForPreviousFrame) {
  const BufferRef a = write("make a", graph.create("a", {64}));
  const BufferRef b = write("make b", graph.create("b", {64}));
  read("look", a);
  read("look", b);
  compile();
  EXPECT_EQ(barrier(0), (Scope{kCompute | kTransfer | kIndirect, kStorageWrite | kTransferWrite, kCompute, kStorageRead | kStorageWrite}));
  EXPECT_EQ(barrier(1), kNoBarrier) << "one barrier serves the whole heap";
}

TEST_F(Barriers, AliasedMemoryWaitsForPreviousUser) {
  const BufferRef a = write("make a", graph.create("a", {64}));
  read("look a", a);
  const BufferRef b = write("make b", graph.create("b", {64}), Use::CopyTarget);
  read("look b", b, Use::CopySource);
  compile();
  ASSERT_EQ(implOf(graph).plans[0].placements[0].offset, implOf(graph).plans[0].placements[1].offset);
  EXPECT_NE(barrier(2).sourceStage & kCompute, 0u);
  EXPECT_EQ(barrier(2).targetStage, kTransfer);
}

}  // namespace
}  // namespace rill::test
