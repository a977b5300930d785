#include "fluid/neighbor_list.hpp"

#include <algorithm>

#include "shared/neighbor_list.h"

namespace rill {
namespace {

/// From which particle the first step starts: the head's distance.
uint32_t headDistance(uint32_t particle, std::span<const uint32_t> neighbors) {
  if (neighbors.empty()) return 0;
  return std::min(particle - std::min(particle, neighbors.front()), kMaxHeadDistance);
}

/// Calls add(entry) for each entry of a list.
template <class Add>
void forEachEntry(uint32_t particle, std::span<const uint32_t> neighbors, Add&& add) {
  uint32_t last = particle - headDistance(particle, neighbors);
  for (const uint32_t j : neighbors) {
    if (j - last >= kLongStep) {
      const uint32_t far = static_cast<uint32_t>(static_cast<int32_t>(j - last) >> kLongStepShift);
      add(kLongStep | (far & 0xFFF));
      last += far << kLongStepShift;
    }
    add(j - last);
    last = j;
  }
}

/// Where a particle's groups lie in its chunk's list, in words; groups follow at a distance of 2 kListBlock.
uint64_t firstWord(uint32_t local, uint32_t capacity) {
  return (uint64_t{local / kListBlock} * capacity / 4 * kListBlock + local % kListBlock) * 2;
}

uint64_t wordOf(uint32_t entry) { return uint64_t{entry / 4} * kListBlock * 2 + entry % 4 / 2; }

/// Calls visit(i, neighbors) for each particle of [first, last); those that exceed the capacity have none.
template <class Visit>
void forEachListed(const FluidSnapshot& s, uint32_t first, uint32_t last, Visit&& visit) {
  last = std::min(last, static_cast<uint32_t>(s.neighborCount.size()));
  uint64_t from = 0;
  for (uint32_t i = 0; i < last; ++i) {
    const uint32_t n = s.neighborCount[i] <= s.listCapacity ? s.neighborCount[i] : 0;
    if (i >= first) visit(i, std::span(s.neighbors).subspan(from, n));
    from += n;
  }
}

}  // namespace

uint32_t listEntries(uint32_t particle, std::span<const uint32_t> neighbors) {
  uint32_t entries = 0;
  forEachEntry(particle, neighbors, [&](uint32_t) { ++entries; });
  return entries;
}

std::vector<uint32_t> layOutHeads(const FluidSnapshot& s) {
  std::vector<uint32_t> heads(s.id.size());
  forEachListed(s, 0, UINT32_MAX, [&](uint32_t i, std::span<const uint32_t> neighbors) {
    const bool listed = s.neighborCount[i] <= s.listCapacity;
    heads[i] = (listed ? listEntries(i, neighbors) : kUnlisted) | headDistance(i, neighbors) << kHeadDistanceShift;
  });
  for (const auto* nearWalls : {&s.nearWall, &s.nearCorner})
    for (const uint32_t i : *nearWalls) heads[i] |= kNearWallsBit;
  return heads;
}

void layOutList(const FluidSnapshot& s, uint32_t first, uint32_t last, std::span<uint32_t> out) {
  forEachListed(s, first, last, [&](uint32_t i, std::span<const uint32_t> neighbors) {
    const uint64_t at = firstWord(i - first, s.listCapacity);
    uint32_t k = 0;
    const auto add = [&](uint32_t entry) {
      uint32_t& word = out[at + wordOf(k)];
      word = k % 2 == 0 ? entry : word | entry << 16;
      ++k;
    };
    forEachEntry(i, neighbors, add);
    while (k % 4 != 0) add(kLongStep);
  });
}

void gatherList(FluidSnapshot& s, uint32_t first, uint32_t last, std::span<const uint32_t> heads, std::span<const uint32_t> list) {
  last = std::min(last, static_cast<uint32_t>(heads.size()));
  for (uint32_t i = first; i < last; ++i) {
    const uint32_t entries = heads[i] & kUnlisted;
    if (entries > s.listCapacity) {
      s.neighborCount.push_back(s.listCapacity + 1);
      continue;
    }
    const uint64_t at = firstWord(i - first, s.listCapacity);
    uint32_t j = i - (heads[i] >> kHeadDistanceShift), count = 0;
    for (uint32_t k = 0; k < entries; ++k) {
      const uint32_t entry = list[at + wordOf(k)] >> 16 * (k % 2) & 0xFFFF;
      j += entry < kLongStep ? entry : static_cast<uint32_t>(static_cast<int32_t>(entry << 20) >> (20 - kLongStepShift));
      if (entry >= kLongStep) continue;
      s.neighbors.push_back(j);
      ++count;
    }
    s.neighborCount.push_back(count);
  }
}

}  // namespace rill
