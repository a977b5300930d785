#include <cstring>

#include "fuzz/require.hpp"
#include "fuzz/targets.hpp"
#include "support/checkpoint_seed.hpp"

namespace rill::test {
namespace {

/// What a fluid of this shape does with it before the device sees it.
void use(const FluidSnapshot& snapshot, const SnapshotShape& shape) {
  if (!checkSnapshot(snapshot, shape) || !hasNeighbors(snapshot)) return;
  std::vector<uint32_t> list(size_t{kListBlock} * shape.listCapacity, shape.count);
  layOutList(snapshot, 0, shape.count, list);
  for (uint32_t entry : list) RILL_REQUIRE(entry <= shape.count);
  std::vector<uint32_t> start(shape.cells + 1);
  cellStarts(snapshot.cell, start);
  for (size_t k = 0; k < shape.cells; ++k) RILL_REQUIRE(start[k] <= start[k + 1] && start[k + 1] <= shape.count);
}

void read(const std::vector<std::byte>& bytes) {
  const auto checkpoint = offline::decodeCheckpoint(bytes, "fuzz");
  if (!checkpoint) {
    RILL_REQUIRE(!checkpoint.error().message.empty());
    return;
  }
  // Numbers may be NaN: what is written again is compared, and only the filling between sections may differ.
  const auto again = offline::encodeCheckpoint(*checkpoint);
  RILL_REQUIRE(again.size() == bytes.size());
  RILL_REQUIRE(offline::decodeCheckpoint(again, "fuzz"));
  use(checkpoint->fluid, seedShape());
}

}  // namespace

int fuzzCheckpoint(const uint8_t* data, size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  read(bytes);
  if (size < 32) return 0;
  const uint64_t whole = size;
  std::memcpy(bytes.data() + 16, &whole, sizeof whole);
  seal(bytes);
  read(bytes);
  return 0;
}

}  // namespace rill::test
