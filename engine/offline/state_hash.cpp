#include "offline/state_hash.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>

namespace rill::offline {
namespace {

class Fnv1a {
 public:
  void add(float value) {
    uint32_t bits = std::bit_cast<uint32_t>(value);
    for (int byte = 0; byte < 4; ++byte, bits >>= 8) hash_ = (hash_ ^ (bits & 0xffu)) * 0x100000001b3ull;
  }
  void add(const Float3& value) { add(value.x), add(value.y), add(value.z); }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace

std::vector<uint32_t> orderById(std::span<const uint32_t> ids) {
  std::vector<uint32_t> order(ids.size(), UINT32_MAX);
  bool dense = true;
  for (uint32_t i = 0; i < ids.size() && dense; ++i) {
    dense = ids[i] < ids.size() && order[ids[i]] == UINT32_MAX;
    if (dense) order[ids[i]] = i;
  }
  if (dense) return order;
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return ids[a] < ids[b]; });
  return order;
}

uint64_t stateHash(std::span<const Float3> positions, std::span<const Float3> velocities, std::span<const uint32_t> ids) {
  assert(positions.size() == ids.size() && velocities.size() == ids.size());
  Fnv1a hash;
  for (const uint32_t i : orderById(ids)) {
    hash.add(positions[i]);
    hash.add(velocities[i]);
  }
  return hash.value();
}

}  // namespace rill::offline
