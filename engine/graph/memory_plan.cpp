#include "graph/memory_plan.hpp"

#include <algorithm>
#include <cassert>

namespace rill {

void MemoryPlanner::plan(std::span<Placement> placements, uint64_t limit, std::vector<uint64_t>& heaps) {
  heaps.clear();
  order_.resize(placements.size());
  for (uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
    return placements[a].first != placements[b].first ? placements[a].first < placements[b].first : a < b;
  });
  for (size_t n = 0; n < order_.size(); ++n) {
    Placement& item = placements[order_[n]];
    assert(item.size > 0 && item.size <= limit);
    taken_.clear();
    for (size_t k = 0; k < n; ++k) {
      const Placement& other = placements[order_[k]];
      if (other.last >= item.first && item.last >= other.first) taken_.push_back({other.heap, other.offset, other.offset + other.size});
    }
    std::sort(taken_.begin(), taken_.end(),
              [](const Taken& a, const Taken& b) { return a.heap != b.heap ? a.heap < b.heap : a.begin < b.begin; });
    item.heap = 0;
    item.offset = 0;
    for (const Taken& taken : taken_) {
      while (item.heap < taken.heap) {  // use the free end of this heap if it is large enough, else try the next heap
        if (item.offset + item.size <= limit) break;
        ++item.heap, item.offset = 0;
      }
      if (item.heap < taken.heap || item.offset + item.size <= taken.begin) break;
      item.offset = std::max(item.offset, (taken.end + item.alignment - 1) / item.alignment * item.alignment);
    }
    if (item.offset + item.size > limit) ++item.heap, item.offset = 0;
    if (item.heap >= heaps.size()) heaps.resize(item.heap + 1, 0);
    heaps[item.heap] = std::max(heaps[item.heap], item.offset + item.size);
  }
}

}  // namespace rill
