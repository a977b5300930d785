// Thousands of random frames, each recorded twice in a row, against Vulkan's rules applied pair by pair: whatever touches the
// same memory, one of them writing, must be ordered, and a write must be available and visible to what reads it.
#include <random>

#include "graph_fixture.hpp"

namespace rill::test {
namespace {

struct Step {  // a pass or a barrier of the recorded sequence
  Scope barrier;
  std::vector<Access> accesses;
};

struct Event {
  size_t step;
  Access access;
};

bool covers(VkPipelineStageFlags2 have, VkPipelineStageFlags2 need) { return (have & kAll) || (have & need) == need; }
bool coversAccess(VkAccessFlags2 have, VkAccessFlags2 need) {
  if (have & kMemoryWrite) have |= kStorageWrite | kTransferWrite;
  return (have & need) == need;
}

class RandomFrames : public GraphTest {
 protected:
  void declare(std::mt19937& random) {
    const auto pick = [&](uint32_t below) { return uint32_t(random() % below); };
    std::vector<BufferRef> refs;
    std::vector<bool> written;
    constexpr Use befores[] = {Use::None, Use::Unknown, Use::ComputeWrite, Use::ComputeRead, Use::CopyTarget, Use::ComputeAtomic, Use::HostRead};
    constexpr Use afters[] = {Use::None, Use::ComputeRead, Use::ComputeWrite, Use::Indirect};
    for (int i = 0; i < 3; ++i) refs.push_back(import("import", befores[pick(7)], afters[pick(4)])), written.push_back(true);
    for (int i = 0; i < 4; ++i) refs.push_back(graph.create("transient", {256 + pick(3) * 256})), written.push_back(false);
    constexpr Use reads[] = {Use::ComputeRead, Use::ComputeTexel, Use::ComputeUniform, Use::Indirect, Use::CopySource};
    constexpr Use writings[] = {Use::ComputeWrite, Use::CopyTarget, Use::ComputeAtomic};
    for (int p = 0; p < 14; ++p)
      graph.pass("pass", [&](Pass& pass) {
        std::vector<bool> used(refs.size());
        for (uint32_t n = 1 + pick(3); n > 0; --n) {
          const uint32_t r = pick(uint32_t(refs.size()));
          if (used[r]) continue;
          used[r] = true;
          if (written[r] && pick(2)) {
            pass.read(refs[r], reads[pick(5)]);
          } else {
            refs[r] = pass.write(refs[r], writings[pick(written[r] ? 3 : 2)], pick(4) == 0);
            written[r] = true;
          }
        }
        if (pick(3) == 0) pass.sideEffect();
        return [](Commands&) {};
      });
  }

  /// The memory that an access touches: imports are told apart by their number, transients by heap and bytes.
  bool sameMemory(const Access& a, const Access& b) {
    const auto& ra = graph.impl().resources[a.resource];
    const auto& rb = graph.impl().resources[b.resource];
    if (ra.imported || rb.imported) return a.resource == b.resource;
    return sharesMemory(graph.impl().placements[ra.placement], graph.impl().placements[rb.placement]);
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
          const Scope& b = steps[s].barrier;
          if (b.empty()) continue;
          const bool direct = covers(b.sourceStage, from.stage);
          if (direct || (b.sourceStage & ordered) || ((b.sourceStage & kAll) && ordered)) ordered |= b.targetStage;
          if (direct && coversAccess(b.sourceAccess, from.write)) available = true;
          if (available && covers(b.targetStage, to.stage) && coversAccess(b.targetAccess, to.read)) visible = true;
        }
        ASSERT_TRUE(covers(ordered, to.stage)) << told(seed, "not ordered", first, second);
        if (!first.access.write) continue;
        ASSERT_TRUE(available) << told(seed, "not available", first, second);
        // Only the latest write is read, and a transient's first write reads nothing.
        const bool reads = !second.access.write || second.access.keep;
        if (same && reads && second.access.version == first.access.version + (second.access.write ? 1u : 0u) && sameFrame(first, second, steps.size())) {
          ASSERT_TRUE(visible) << told(seed, "not visible", first, second);
        }
      }
  }
  std::string told(uint32_t seed, const char* what, const Event& a, const Event& b) {
    const auto text = [](const Event& e) {
      return std::string(useRow(e.access.use).name) + " of resource " + std::to_string(e.access.resource) + " v" + std::to_string(e.access.version) + " in step " + std::to_string(e.step);
    };
    return "seed " + std::to_string(seed) + ", " + what + ": " + text(a) + ", then " + text(b) + "\n" + graph.json();
  }
  static bool sameFrame(const Event& a, const Event& b, size_t steps) { return (a.step < steps / 2) == (b.step < steps / 2); }
};

TEST_F(RandomFrames, EveryConflictIsOrdered) {
  for (uint32_t seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    graph.reset();
    declare(random);
    compile();
    const GraphImpl& g = graph.impl();
    for (size_t a = 0; a < g.placements.size(); ++a)
      for (size_t b = 0; b < a; ++b)
        if (g.placements[a].first <= g.placements[b].last && g.placements[b].first <= g.placements[a].last) {
          ASSERT_FALSE(sharesMemory(g.placements[a], g.placements[b])) << "seed " << seed;
        }
    std::vector<Step> steps;
    for (int frame = 0; frame < 2; ++frame) {
      for (const PassData& pass : g.passes) {
        if (!pass.alive) continue;
        Step step{pass.barrier.scope, {}};
        for (uint32_t k = pass.accesses.first; k < pass.accesses.first + pass.accesses.count; ++k) {
          // The imports' states are a promise about one frame: the second frame's are not checked against the first's.
          if (frame == 0 || !g.resources[g.accesses[k].resource].imported) step.accesses.push_back(g.accesses[k]);
        }
        steps.push_back(step);
      }
      steps.push_back({g.finalBarrier.scope, {}});
    }
    check(steps, seed);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace rill::test
