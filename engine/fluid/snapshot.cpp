#include "fluid/snapshot.hpp"

#include "fluid/sleep.hpp"
#include "fluid/snapshot_words.hpp"

namespace rill {

uint64_t flowWords(const FluidSetup& setup) {
  if (!setup.removes) return 0;
  return (sizeof(FlowRecord) + setup.emitters.size() * sizeof(EmitterRecord) + setup.drains.size() * sizeof(DrainRecord)) / 4;
}

SnapshotShape snapshotShape(const FluidSetup& setup) {
  return {.capacity = setup.params.capacity,
          .solidCount = setup.params.solidCount,
          .bodyCount = setup.params.bodyCount,
          .contactPoints = setup.params.contactPoints,
          .listCapacity = setup.params.listCapacity,
          .emitterCount = setup.params.emitterCount,
          .fluids = setup.fluids,
          .flowWords = flowWords(setup),
          .regions = regionCount(setup.params),
          .cells = setup.grid.cells(),
          .initialPressureIterations = setup.params.initialPressureIterations,
          .segments = setup.walls && !setup.thin,
          .tension = setup.params.tensionRate > 0,
          .movingSolids = setup.movingSolids};
}

bool hasNeighbors(const FluidSnapshot& snapshot) { return readRecord<FluidControl>(snapshot.control).listState == kListValid; }

void cellStarts(std::span<const uint32_t> cell, std::span<uint32_t> start) {
  size_t i = 0;
  for (size_t key = 0; key < start.size(); ++key) {
    while (i < cell.size() && cell[i] < key) ++i;
    start[key] = static_cast<uint32_t>(i);
  }
}

}  // namespace rill
