// Checks thousands of random frames, each recorded twice, against Vulkan's memory model, pair by pair:
// conflicting accesses must be ordered, and writes must be available and visible to their readers.
#include <random>

#include "graph_fixture.hpp"

namespace rill::test {
namespace {

struct Barrier {
  Scope scope;
  uint32_t image = kNone;  // for a layout transition: the image whose memory it covers
};

struct Step {  // a pass or a barrier of the recorded sequence
  std::vector<Barrier> barriers;
  std::vector<Access> accesses;
  std::vector<Transition> transitions;
};

struct Event {
  size_t step;
  Access access;
};

bool covers(VkPipelineStageFlags2 have, VkPipelineStageFlags2 need) { return (have & kAll) || (have & need) == need; }
bool coversAccess(VkAccessFlags2 have, VkAccessFlags2 need) {
  if (have & kMemoryWrite) have |= kStorageWrite | kTransferWrite | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
  return (have & need) == need;
}

class RandomFrames : public GraphTest {
 protected:
  void declare(std::mt19937& random) {
    const auto pick = [&](uint32_t below) { return uint32_t(random() % below); };
    // Some frames reuse memory often: many transients, most of them used by a few consecutive passes.
    const bool chain = pick(8) == 0;
    const uint32_t imports = 3, transients = chain ? 20 : 4, passes = chain ? 40 : 14;
    std::vector<BufferRef> refs;
    std::vector<bool> written;
    constexpr Use befores[] = {Use::Nothing,    Use::Unknown,       Use::ComputeWrite, Use::ComputeRead,
                               Use::CopyTarget, Use::ComputeAtomic, Use::HostRead};
    constexpr Use afters[] = {Use::Nothing, Use::ComputeRead, Use::ComputeWrite, Use::Indirect};
    for (uint32_t i = 0; i < imports; ++i) refs.push_back(import("import", befores[pick(7)], afters[pick(4)])), written.push_back(true);
    for (uint32_t i = 0; i < transients; ++i)
      refs.push_back(graph.create("transient", {256 + pick(chain ? 8 : 3) * 256})), written.push_back(false);
    constexpr Use reads[] = {Use::ComputeRead, Use::ComputeTexel, Use::ComputeUniform, Use::DrawTexel,
                             Use::Indirect,    Use::CopySource,   Use::VertexInput};
    constexpr Use writings[] = {Use::ComputeWrite, Use::CopyTarget, Use::ComputeAtomic};
    const ImportState imageStates[] = {
        Use::Nothing,    Use::Unknown,    Use::ComputeWrite, Use::ComputeSampled,
        Use::CopySource, Use::CopyTarget, Use::Present,      UseState{kCompute, kSampled, VK_IMAGE_LAYOUT_GENERAL}};
    constexpr Use imageReads[] = {Use::ComputeRead, Use::ComputeSampled, Use::CopySource, Use::DrawSampled};
    std::vector<ImageRef> images;
    std::vector<bool> drawn;
    for (uint64_t i = 0; i < 2; ++i) {
      const ImportState before = imageStates[pick(8)];
      const ImportState after = pick(2) ? imageStates[2 + pick(6)] : Use::Nothing;
      images.push_back(graph.import("imported image", {reinterpret_cast<VkImage>(100 + i), {VK_FORMAT_R32_SFLOAT, 16, 16}, before, after}));
      drawn.push_back(before != Use::Nothing && before != Use::Unknown);
    }
    for (int i = 0; i < 4; ++i)
      images.push_back(graph.create("image", {VK_FORMAT_R32_SFLOAT, 16, 16 + 16 * pick(2)})), drawn.push_back(false);
    for (uint32_t p = 0; p < passes; ++p)
      graph.pass("pass", [&](Pass& pass) {
        std::vector<bool> used(refs.size());
        for (uint32_t n = 1 + pick(3); n > 0; --n) {
          const uint32_t near = imports + std::min(p / 2 + pick(3), transients - 1);
          const uint32_t r = chain && pick(16) ? near : pick(uint32_t(refs.size()));
          if (used[r]) continue;
          used[r] = true;
          if (written[r] && pick(2)) {
            pass.read(refs[r], reads[pick(7)]);
          } else {
            refs[r] = pass.write(refs[r], writings[pick(written[r] ? 3 : 2)], pick(4) == 0);
            written[r] = true;
          }
        }
        std::vector<bool> seen(images.size());
        bool target = false;
        for (uint32_t n = pick(3); n > 0; --n) {
          const uint32_t r = pick(uint32_t(images.size()));
          if (seen[r]) continue;
          seen[r] = true;
          if (drawn[r] && pick(2)) {
            pass.read(images[r], imageReads[pick(4)]);
          } else {
            constexpr Use imageWritings[] = {Use::ComputeWrite, Use::CopyTarget, Use::ColorTarget};
            const Use use = imageWritings[pick(target ? 2 : 3)];  // at most one target, since targets of a pass must have equal sizes
            target |= use == Use::ColorTarget;
            const bool discard = pick(4) == 0 || (use == Use::ColorTarget && !drawn[r]);
            images[r] = pass.write(images[r], use, discard ? Load::Discard : Load::Keep);
            drawn[r] = true;
          }
        }
        if (pick(3) == 0) pass.sideEffect();
        return [](Commands&) {};
      });
  }

  /// Whether two accesses touch the same memory: compares imports by index, transients by heap and byte range.
  bool sameMemory(const Access& a, const Access& b) {
    const auto& ra = implOf(graph).resources[a.resource];
    const auto& rb = implOf(graph).resources[b.resource];
    if (ra.imported || rb.imported || ra.isImage != rb.isImage) return a.resource == b.resource;
    const auto& placements = implOf(graph).planOf(ra).placements;
    return sharesMemory(placements[ra.placement], placements[rb.placement]);
  }

  /// Every use finds the right layout; transitions start from the current layout and keep needed content.
  void checkLayouts(const std::vector<Step>& steps, uint32_t seed) {
    const auto& resources = implOf(graph).resources;
    std::vector<VkImageLayout> layout(resources.size());
    for (size_t s = 0; s < steps.size(); ++s) {
      if (s == 0 || s == steps.size() / 2)
        for (size_t r = 0; r < resources.size(); ++r) layout[r] = useRow(resources[r].before).layout;
      for (const Transition& t : steps[s].transitions) {
        ASSERT_NE(t.to, VK_IMAGE_LAYOUT_UNDEFINED) << "seed " << seed;
        for (const Access& access : steps[s].accesses)
          if (access.resource == t.resource && access.keep) { ASSERT_EQ(t.from, layout[t.resource]) << "seed " << seed << ", step " << s; }
        if (t.from != VK_IMAGE_LAYOUT_UNDEFINED) { ASSERT_EQ(t.from, layout[t.resource]) << "seed " << seed << ", step " << s; }
        layout[t.resource] = t.to;
      }
      for (const Access& access : steps[s].accesses)
        if (resources[access.resource].isImage) {
          ASSERT_EQ(layout[access.resource], useRow(access.use).layout) << "seed " << seed << ", step " << s;
        }
      if (s + 1 == steps.size() / 2 || s + 1 == steps.size())
        for (size_t r = 0; r < resources.size(); ++r)
          if (resources[r].imported && resources[r].isImage && resources[r].after != Use::Nothing) {
            ASSERT_EQ(layout[r], useRow(resources[r].after).layout) << "seed " << seed;
          }
    }
  }

  /// Barriers of a pass. `all`: those of imported images too, of which the second frame's are not checked against the first's.
  Step stepOf(const PlannedBarrier& planned, bool all) {
    const GraphImpl& g = implOf(graph);
    Step step;
    step.barriers.push_back({planned.scope});
    for (uint32_t k = planned.transitions.first; k < planned.transitions.first + planned.transitions.count; ++k) {
      step.transitions.push_back(g.transitions[k]);
      if (all || !g.resources[g.transitions[k].resource].imported)
        step.barriers.push_back({g.transitions[k].scope, g.transitions[k].resource});
    }
    return step;
  }

  /// A layout transition reads and writes the image, so it must wait for all earlier accesses to its memory.
  void checkChanges(const std::vector<Step>& steps, uint32_t seed) {
    for (size_t i = 0; i < steps.size(); ++i)
      for (const Access& access : steps[i].accesses) {
        VkPipelineStageFlags2 ordered = 0;
        for (size_t s = i + 1; s < steps.size(); ++s) {
          const VkPipelineStageFlags2 before = ordered;
          for (const auto& [b, image] : steps[s].barriers) {
            const bool waits = covers(b.sourceStage, useRow(access.use).stage) || (b.sourceStage & before);
            if (image != kNone && sameMemory(access, {image})) {
              ASSERT_TRUE(waits) << "seed " << seed << ": a layout transition in step " << s << " does not wait for step " << i << "\n"
                                 << graph.json();
            }
            if (waits) ordered |= b.targetStage;
          }
        }
      }
  }

  void check(const std::vector<Step>& steps, uint32_t seed) {
    std::vector<Event> events;
    for (size_t s = 0; s < steps.size(); ++s)
      for (const Access& access : steps[s].accesses) events.push_back({s, access});
    for (size_t j = 0; j < events.size(); ++j)
      for (size_t i = 0; i < j; ++i) {
        const Event &first = events[i], &second = events[j];
        if (first.step == second.step || !sameMemory(first.access, second.access)) continue;
        if (!first.access.write && !second.access.write) continue;
        const bool same = first.access.resource == second.access.resource;
        if (same && first.access.use == Use::ComputeAtomic && second.access.use == Use::ComputeAtomic) continue;
        const UseRow &from = useRow(first.access.use), &to = useRow(second.access.use);
        VkPipelineStageFlags2 ordered = 0;
        bool available = false, visible = false;
        for (size_t s = first.step + 1; s <= second.step; ++s) {
          const VkPipelineStageFlags2 before = ordered;  // barriers of one call are not ordered among themselves
          for (const auto& [b, image] : steps[s].barriers) {
            if (b.empty()) continue;
            const bool direct = covers(b.sourceStage, from.stage), chained = (b.sourceStage & before) || ((b.sourceStage & kAll) && before);
            const bool own = image == first.access.resource;
            if (direct || chained) ordered |= b.targetStage;
            if (image != kNone && !own) continue;
            if (own || (direct && coversAccess(b.sourceAccess, from.write))) available = true;
            if (available && covers(b.targetStage, to.stage) && coversAccess(b.targetAccess, to.read)) visible = true;
          }
        }
        ASSERT_TRUE(covers(ordered, to.stage)) << told(seed, "not ordered", first, second);
        if (!first.access.write || (!same && implOf(graph).resources[second.access.resource].isImage)) continue;
        ASSERT_TRUE(available) << told(seed, "not available", first, second);
        // Only the latest write is read, and a transient's first write reads nothing.
        const bool reads = !second.access.write || second.access.keep;
        if (same && reads && second.access.version == first.access.version + (second.access.write ? 1u : 0u) &&
            sameFrame(first, second, steps.size())) {
          ASSERT_TRUE(visible) << told(seed, "not visible", first, second);
        }
      }
  }
  std::string told(uint32_t seed, const char* what, const Event& a, const Event& b) {
    const auto text = [](const Event& e) {
      return std::string(useRow(e.access.use).name) + " of resource " + std::to_string(e.access.resource) + " v" +
             std::to_string(e.access.version) + " in step " + std::to_string(e.step);
    };
    return "seed " + std::to_string(seed) + ", " + what + ": " + text(a) + ", then " + text(b) + "\n" + graph.json();
  }
  static bool sameFrame(const Event& a, const Event& b, size_t steps) { return (a.step < steps / 2) == (b.step < steps / 2); }
};

TEST_F(RandomFrames, SynchronizesEveryConflict) {
  size_t covered = 0, frames = 0;
  for (uint32_t seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    graph.reset();
    declare(random);
    compile();
    const GraphImpl& g = implOf(graph);
    for (const TransientPlan& plan : g.plans)
      for (const Placement& a : plan.placements)
        for (const Placement& b : plan.placements)
          if (&a < &b && a.first <= b.last && b.first <= a.last) { ASSERT_FALSE(sharesMemory(a, b)) << "seed " << seed; }
    const size_t placed = g.plans[0].placements.size(), waitedFor = g.plans[0].aliasCandidates.size();
    frames += waitedFor > 1 && waitedFor < placed;
    covered += placed - waitedFor;
    std::vector<Step> steps;
    for (int frame = 0; frame < 2; ++frame) {
      for (const PassData& pass : g.passes) {
        if (!pass.alive) continue;
        Step step = stepOf(pass.barrier, frame == 0);
        for (uint32_t k = pass.accesses.first; k < pass.accesses.first + pass.accesses.count; ++k) {
          // The imports' states are a promise about one frame: the second frame's are not checked against the first's.
          if (frame == 0 || !g.resources[g.accesses[k].resource].imported) step.accesses.push_back(g.accesses[k]);
        }
        steps.push_back(step);
      }
      steps.push_back(stepOf(g.finalBarrier, frame == 0));
    }
    checkLayouts(steps, seed);
    if (HasFatalFailure()) return;
    checkChanges(steps, seed);
    if (HasFatalFailure()) return;
    check(steps, seed);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(covered, 3000u) << "transients whose memory was reused completely";
  EXPECT_GT(frames, 500u) << "frames that also have partly reused or unshared transients";
}

// A repeated frame reuses its plan, any other frame gets a new one. The test above checks the plans themselves.
TEST_F(RandomFrames, OnlyEqualFramesReuseThePlan) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    std::string planned;
    for (int time = 0; time < 3; ++time) {
      std::mt19937 random(seed);
      graph.reset();
      declare(random);
      compile();
      ASSERT_EQ(implOf(graph).plansMade, seed + 1) << "seed " << seed << ", time " << time;
      if (time == 0) planned = graph.json();
      ASSERT_EQ(graph.json(), planned) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace rill::test
