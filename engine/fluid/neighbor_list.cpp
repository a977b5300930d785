#include "fluid/neighbor_list.hpp"

#include <algorithm>

#include "shared/neighbor_list.h"
#include "shared/region_records.h"

namespace rill {
namespace {

bool hasSegments(std::span<const uint32_t> neighbors) { return !neighbors.empty() && neighbors.front() >= kImageOfNeighbors; }

/// From which particle the first step of each segment starts: the head's distance.
uint32_t headDistance(uint32_t particle, std::span<const uint32_t> neighbors) {
  const auto first = std::ranges::find_if(neighbors, [](uint32_t j) { return j < kImageOfNeighbors; });
  return first == neighbors.end() ? 0 : std::min(particle - std::min(particle, *first), kMaxHeadDistance);
}

/// Calls add(entry) for each entry of a list, those that fill groups of four too, but for the last of a list without segments.
template <class Add>
void forEachEntry(uint32_t particle, std::span<const uint32_t> neighbors, Add&& add) {
  const uint32_t first = particle - headDistance(particle, neighbors);
  std::vector<uint32_t> segment;
  uint32_t last = first, image = 0;
  const bool segmented = hasSegments(neighbors);
  const auto finish = [&] {
    while (segmented && segment.size() % 4 != 0) segment.push_back(kLongStep);
    if (segmented && !segment.empty()) segment.front() = kLongStep | image << kSegmentGroupBits | static_cast<uint32_t>(segment.size() / 4);
    for (const uint32_t entry : segment) add(entry);
    segment.clear();
  };
  for (const uint32_t j : neighbors) {
    if (j >= kImageOfNeighbors) {
      finish();
      image = j - kImageOfNeighbors;
      segment.push_back(0);
      last = first;
      continue;
    }
    if (j - last >= kLongStep) {
      const uint32_t far = static_cast<uint32_t>(static_cast<int32_t>(j - last) >> kLongStepShift);
      segment.push_back(kLongStep | (far & 0xFFF));
      last += far << kLongStepShift;
    }
    segment.push_back(j - last);
    last = j;
  }
  finish();
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
    heads[i] = (listed ? listEntries(i, neighbors) : kUnlisted) | (hasSegments(neighbors) ? kSegmentsBit : 0) |
               headDistance(i, neighbors) << kHeadDistanceShift;
  });
  for (const NearSolids& near : s.nearSolids) heads[near.particle] |= kNearSolidsBit;
  for (size_t i = 0; i < s.rest.size(); ++i)
    if (s.rest[i] != kZoneMoves) heads[i] |= kAsleepBit;
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
    const bool segmented = heads[i] & kSegmentsBit;
    const uint64_t at = firstWord(i - first, s.listCapacity);
    const uint32_t start = i - (heads[i] >> kHeadDistanceShift);
    uint32_t j = start, segmentEnd = 0;
    const size_t before = s.neighbors.size();
    for (uint32_t k = 0; k < entries; ++k) {
      const uint32_t entry = list[at + wordOf(k)] >> 16 * (k % 2) & 0xFFFF;
      if (segmented && k == segmentEnd) {
        segmentEnd += std::max(4 * (entry & kMaxSegmentGroups), 4u);
        s.neighbors.push_back(kImageOfNeighbors + ((entry & 0xFFF) >> kSegmentGroupBits));
        j = start;
        continue;
      }
      j += entry < kLongStep ? entry : static_cast<uint32_t>(static_cast<int32_t>(entry << 20) >> (20 - kLongStepShift));
      if (entry < kLongStep) s.neighbors.push_back(j);
    }
    s.neighborCount.push_back(static_cast<uint32_t>(s.neighbors.size() - before));
  }
}

}  // namespace rill
