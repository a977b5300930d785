#include "fluid/near_solids.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

#include "fluid/snapshot.hpp"
#include "shared/solid_records.h"

namespace rill {
namespace {

constexpr size_t kQuadWords = 4;
static_assert(sizeof(NearSolids) == kMaxNearQuads * kQuadWords * sizeof(uint32_t));
static_assert(sizeof(NearSolids::solids) == kListedSolids * sizeof(uint16_t));

NearSolids nothingNear() {
  NearSolids near;
  near.solids.fill(kNoSolid);
  return near;
}

bool anyMayBeNear(const FluidSnapshot& s) { return s.nearSolids.empty() && !hasNeighbors(s); }

}  // namespace

uint32_t nearSolidQuads(uint64_t solids) {
  const uint64_t halves = solids + 2;  // the particle takes two
  return static_cast<uint32_t>(std::min<uint64_t>((halves + 7) / 8, kMaxNearQuads));
}

size_t nearSolidCount(const FluidSnapshot& s) { return anyMayBeNear(s) ? s.id.size() : s.nearSolids.size(); }

std::vector<uint32_t> layOutNearSolids(const FluidSnapshot& s, uint32_t quads) {
  NearSolids any = nothingNear();
  any.solids[0] = kAllSolids;
  const size_t words = kQuadWords * quads;
  std::vector<uint32_t> out(words * nearSolidCount(s));
  for (uint32_t n = 0; n < nearSolidCount(s); ++n) {
    any.particle = n;
    std::memcpy(&out[words * n], anyMayBeNear(s) ? &any : &s.nearSolids[n], words * sizeof(uint32_t));
  }
  return out;
}

std::vector<NearSolids> gatherNearSolids(std::span<const uint32_t> words, uint32_t quads) {
  const size_t each = kQuadWords * quads;
  std::vector<NearSolids> all(words.size() / each, nothingNear());
  for (size_t n = 0; n < all.size(); ++n) {
    const std::span<const uint32_t> entry = words.subspan(each * n, each);
    all[n].particle = entry[0];
    std::memcpy(all[n].solids.data(), &entry[1], entry.size_bytes() - sizeof(uint32_t));
  }
  return all;
}

bool listsSolids(const NearSolids& near, uint32_t solidCount) {
  if (near.solids[0] == kAllSolids) return true;
  const auto end = std::ranges::find(near.solids, uint16_t{kNoSolid});
  return end != near.solids.begin() && std::all_of(end, near.solids.end(), [](uint16_t k) { return k == kNoSolid; }) &&
         std::all_of(near.solids.begin(), end, [&](uint16_t k) { return k < solidCount; }) &&
         std::adjacent_find(near.solids.begin(), end, std::greater_equal<>()) == end;
}

}  // namespace rill
