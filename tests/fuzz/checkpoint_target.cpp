#include <bit>
#include <cmath>
#include <cstring>

#include "fluid/neighbor_list.hpp"
#include "fuzz/require.hpp"
#include "fuzz/targets.hpp"
#include "support/checkpoint_seed.hpp"

namespace rill::test {
namespace {

/// What the device adds to is a number.
void requireValidReadings(const FluidSnapshot& snapshot) {
  for (size_t at = 0; at < snapshot.pressures.size(); at += kPressureProbeWords) {
    for (size_t word = 0; word < offsetof(PressureProbeRecord, covered) / 4; ++word)
      RILL_REQUIRE(std::isfinite(std::bit_cast<float>(snapshot.pressures[at + word])));
    RILL_REQUIRE(std::bit_cast<float>(snapshot.pressures[at + offsetof(PressureProbeRecord, advanceTime) / 4]) >= 0);
  }
}

/// The host code that loads a snapshot into a fluid of this shape.
void loadIntoFluid(const FluidSnapshot& snapshot, const SnapshotShape& shape) {
  if (!checkSnapshot(snapshot, shape)) return;
  requireValidReadings(snapshot);
  if (!hasNeighbors(snapshot)) return;
  std::vector<uint32_t> list(size_t{kListBlock} * shape.listCapacity / 2);
  layOutList(snapshot, 0, shape.capacity, list);
  FluidSnapshot back = snapshot;
  back.neighbors.clear();
  back.neighborCount.clear();
  gatherList(back, 0, shape.capacity, layOutHeads(snapshot), list);
  RILL_REQUIRE(back.neighbors == snapshot.neighbors);
  std::vector<uint32_t> start(shape.cells + 1);
  cellStarts(snapshot.cell, start);
  for (size_t k = 0; k < shape.cells; ++k) RILL_REQUIRE(start[k] <= start[k + 1] && start[k + 1] <= shape.capacity);
}

void checkRoundTrip(const std::vector<std::byte>& bytes) {
  const auto checkpoint = offline::decodeCheckpoint(bytes, "fuzz");
  if (!checkpoint) {
    RILL_REQUIRE(!checkpoint.error().message.empty());
    return;
  }
  // Compares sizes instead of bytes: padding between sections may differ.
  const auto encoded = offline::encodeCheckpoint(*checkpoint);
  RILL_REQUIRE(encoded.size() == bytes.size());
  RILL_REQUIRE(offline::decodeCheckpoint(encoded, "fuzz"));
  for (const SnapshotShape& shape : {seedShape(), seedShapeWithBodies()}) loadIntoFluid(checkpoint->fluid, shape);
}

}  // namespace

int fuzzCheckpoint(const uint8_t* data, size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  checkRoundTrip(bytes);
  if (size < 32) return 0;
  const uint64_t whole = size;
  std::memcpy(bytes.data() + 16, &whole, sizeof whole);
  seal(bytes);
  checkRoundTrip(bytes);
  return 0;
}

}  // namespace rill::test
