#include "offline/state_hash.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>

#include "core/fnv1a.hpp"

namespace rill::offline {
namespace {

void add(Fnv1a& hash, const Float3& value) {
  for (float number : {value.x, value.y, value.z}) hash.add(std::bit_cast<uint32_t>(number));
}

void add(Fnv1a& hash, const Double3& value) {
  for (double number : {value.x, value.y, value.z}) hash.add(std::bit_cast<uint64_t>(number));
}

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

uint64_t stateHash(std::span<const Float3> positions, std::span<const Float3> velocities, std::span<const uint32_t> ids,
                   std::span<const BodyMotion> bodies, std::span<const uint8_t> fluids, std::span<const Float4> concentrations) {
  assert(positions.size() == ids.size() && velocities.size() == ids.size());
  assert((fluids.empty() || fluids.size() == ids.size()) && (concentrations.empty() || concentrations.size() == ids.size()));
  Fnv1a hash;
  const std::vector<uint32_t> order = orderById(ids);
  for (const uint32_t i : order) {
    add(hash, positions[i]);
    add(hash, velocities[i]);
  }
  for (const BodyMotion& body : bodies) {
    for (const Double3& v : {body.center, body.velocity, body.angularVelocity}) add(hash, v);
    add(hash, Double3{body.rotation.x, body.rotation.y, body.rotation.z});
    hash.add(std::bit_cast<uint64_t>(body.rotation.w));
  }
  if (std::ranges::any_of(fluids, [](uint8_t fluid) { return fluid != 0; }))
    for (const uint32_t i : order) hash.add(uint32_t{fluids[i]});
  if (concentrations.empty()) return hash.value();
  for (const uint32_t i : order)
    for (float number : {concentrations[i].x, concentrations[i].y, concentrations[i].z, concentrations[i].w})
      hash.add(std::bit_cast<uint32_t>(number));
  return hash.value();
}

}  // namespace rill::offline
