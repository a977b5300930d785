// Every change that a plan depends on leads to a new plan.
#include <functional>
#include <vector>

#include "graph_fixture.hpp"

namespace rill::test {
namespace {

struct Declared {
  std::string_view pass = "make", resource = "made";
  uint64_t bytes = 256;
  VkFormat format = VK_FORMAT_R32_SFLOAT;
  uint32_t side = 16, levels = 1;
  Use before = Use::ComputeWrite, after = Use::ComputeRead, reading = Use::ComputeRead;
  Load load = Load::Keep;
  bool root = true, more = false, back = false;
  uint64_t handle = 7;
};

class PlanReuse : public GraphTest {
 protected:
  void frame(const Declared& d) {
    graph.reset();
    BufferRef in = graph.import("in", {fakeBuffer(d.handle), 0, 1024, d.before, d.after});
    BufferRef made = graph.create(d.resource, {d.bytes});
    ImageRef image = graph.create("image", {d.format, d.side, 16, d.levels});
    graph.pass(d.pass, [&](Pass& pass) {
      pass.read(in, d.reading);
      made = pass.write(made, Use::ComputeWrite);
      image = pass.write(image, Use::ComputeWrite);
      return [](Commands&) {};
    });
    graph.pass("draw", [&](Pass& pass) {
      pass.read(made, Use::ComputeRead);
      image = pass.write(image, Use::ComputeWrite, d.load);
      if (d.root) pass.sideEffect();
      return [](Commands&) {};
    });
    if (d.more) read("look", made);
    if (d.back) (void)graph.readback(made);
    compile();
  }
  uint64_t plans() { return implOf(graph).plansMade; }
};

TEST_F(PlanReuse, EachChangeMakesOneNewPlan) {
  const std::vector<std::function<void(Declared&)>> changes = {
      [](Declared& d) { d.pass = "make more"; },
      [](Declared& d) { d.resource = "other"; },
      [](Declared& d) { d.bytes = 512; },
      [](Declared& d) { d.format = VK_FORMAT_R32_UINT; },
      [](Declared& d) { d.side = 32; },
      [](Declared& d) { d.levels = 2; },
      [](Declared& d) { d.before = Use::CopyTarget; },
      [](Declared& d) { d.after = Use::Indirect; },
      [](Declared& d) { d.reading = Use::ComputeTexel; },
      [](Declared& d) { d.load = Load::Discard; },
      [](Declared& d) { d.root = false; },
      [](Declared& d) { d.more = true; },
      [](Declared& d) { d.back = true; },
  };
  for (size_t k = 0; k < changes.size(); ++k) {
    Declared changed;
    changes[k](changed);
    frame({});
    const uint64_t before = plans();
    frame({});
    EXPECT_EQ(plans(), before) << k;
    frame(changed);
    EXPECT_EQ(plans(), before + 1) << k;
    frame(changed);
    EXPECT_EQ(plans(), before + 1) << k;
  }
}

TEST_F(PlanReuse, ChangedHandlesReusePlan) {
  frame({});
  Declared other;
  other.handle = 8;
  frame(other);
  EXPECT_EQ(plans(), 1u);
}

TEST_F(PlanReuse, UncompiledFrameKeepsPlan) {
  frame({});
  graph.reset();
  (void)write("something else", graph.create("made", {64}));
  frame({});
  EXPECT_EQ(plans(), 1u);
}

TEST_F(PlanReuse, PassesAddedAfterCompileArePlanned) {
  frame({});
  read("added", write("make it", graph.create("late", {64})));
  compile();
  EXPECT_EQ(plans(), 2u);
  EXPECT_TRUE(alive(3));
}

}  // namespace
}  // namespace rill::test
