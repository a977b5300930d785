#include "offline/readout.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>

#include "shared/fluid_records.h"

namespace rill::offline {
namespace {

/// The first `count` records of a read-back; buffers may be longer.
template <class Record>
std::vector<Record> records(std::span<const std::byte> bytes, uint32_t count) {
  assert(bytes.size() >= size_t{count} * sizeof(Record));
  std::vector<Record> copy(count);
  std::memcpy(copy.data(), bytes.data(), size_t{count} * sizeof(Record));
  return copy;
}

}  // namespace

ReadoutTickets readout(Graph& graph, const FluidState& state) {
  ReadoutTickets tickets;
  tickets.capacity = state.capacity;
  if (state.capacity == 0) return tickets;
  tickets.particles = graph.readback(state.countBuffer);
  tickets.position = graph.readback(state.position);
  tickets.velocity = graph.readback(state.velocity);
  tickets.id = graph.readback(state.id);
  tickets.mixes = state.concentration != BufferRef{};
  if (tickets.mixes) tickets.concentration = graph.readback(state.concentration);
  return tickets;
}

Readout collect(const Graph& graph, const ReadoutTickets& tickets) {
  Readout result;
  if (tickets.capacity == 0) return result;
  const uint32_t count = std::min(records<uint32_t>(graph.data(tickets.particles), 1).front(), tickets.capacity);
  const auto positions = records<Float4>(graph.data(tickets.position), count);
  const auto velocities = records<Float4>(graph.data(tickets.velocity), count);
  result.ids = records<uint32_t>(graph.data(tickets.id), count);
  if (tickets.mixes) result.concentrations = records<Float4>(graph.data(tickets.concentration), count);
  result.positions.reserve(count);
  result.velocities.reserve(count);
  result.relativeDensities.reserve(count);
  result.fluids.reserve(count);
  for (uint32_t i = 0; i < count; ++i) {
    result.positions.push_back({positions[i].x, positions[i].y, positions[i].z});
    result.velocities.push_back({velocities[i].x, velocities[i].y, velocities[i].z});
    result.relativeDensities.push_back(velocities[i].w);
    const float fluid = positions[i].w;
    result.fluids.push_back(fluid >= 0 && fluid < static_cast<float>(kMaxFluids) ? static_cast<uint8_t>(fluid) : uint8_t{0});
  }
  return result;
}

Readout activeOnly(const Readout& all) {
  Readout active;
  for (size_t i = 0; i < all.ids.size(); ++i) {
    if (all.positions[i].x >= kInactiveLimit) continue;
    active.positions.push_back(all.positions[i]);
    active.velocities.push_back(all.velocities[i]);
    active.relativeDensities.push_back(all.relativeDensities[i]);
    active.ids.push_back(all.ids[i]);
    active.fluids.push_back(all.fluids[i]);
    if (!all.concentrations.empty()) active.concentrations.push_back(all.concentrations[i]);
  }
  return active;
}

}  // namespace rill::offline
