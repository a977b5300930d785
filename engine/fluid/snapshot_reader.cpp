// A fluid's state from the device, buffer by buffer.
#include <algorithm>
#include <cstring>

#include "fluid/fluid_impl.hpp"
#include "fluid/snapshot.hpp"
#include "graph/import_whole.hpp"

namespace rill {
namespace {

/// What is read, in this order; kLists + c is list buffer c.
enum Part : uint32_t { kSmall, kPosition, kVelocity, kPush, kWarm, kId, kNear, kCounts, kCells, kLists };

template <class Record>
std::vector<Record> records(std::span<const std::byte> bytes, size_t count) {
  std::vector<Record> all(count);
  std::memcpy(all.data(), bytes.data(), count * sizeof(Record));
  return all;
}

std::vector<Float3> vectors(std::span<const std::byte> bytes, size_t count) {
  std::vector<Float3> all(count);
  for (size_t i = 0; i < count; ++i) std::memcpy(&all[i], bytes.data() + 16 * i, sizeof all[i]);
  return all;
}

/// Theirs is the order in which threads met, which no bit depends on; a file should not, either.
std::vector<uint32_t> sorted(std::span<const uint32_t> words) {
  std::vector<uint32_t> all(words.begin(), words.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

SnapshotReader::SnapshotReader(const Fluid& fluid) : fluid_(implOf(fluid)) {
  if (fluid_.count > 0) parts_ = {kSmall};
}

bool SnapshotReader::done() const { return next_ == parts_.size(); }

void SnapshotReader::declare(Graph& graph) {
  tickets_.clear();
  const FluidBuffers& buffers = fluid_.buffers();
  const auto read = [&](const Buffer& buffer) { tickets_.push_back(graph.readback(importWhole(graph, "state", buffer))); };
  const uint32_t part = parts_[next_];
  if (part == kSmall) {
    read(buffers.control);
    read(buffers.sums);
    read(buffers.solids);
    return;
  }
  const Buffer* const single[] = {nullptr,       &buffers.position, &buffers.velocity, &buffers.warmAcceleration,
                                  &buffers.warm, &buffers.id,       &buffers.nearList, &buffers.neighborCount,
                                  &buffers.cell};
  read(part < kLists ? *single[part] : buffers.lists[part - kLists]);
}

Expected<void> SnapshotReader::take(const Graph& graph) {
  std::vector<std::span<const std::byte>> data;
  for (Ticket ticket : tickets_) {
    data.push_back(graph.data(ticket));
    if (data.back().empty()) return Error{ErrorKind::Failed, "reading the state back: no data came back"};
  }
  FluidSnapshot& s = snapshot_;
  const uint32_t n = fluid_.count, part = parts_[next_++];
  switch (part) {
    case kSmall: {
      // Of the advance before, the next one begins with none of them.
      FluidControl control;
      std::memcpy(&control, data[0].data(), sizeof control);
      control.substeps = control.iterations = control.builds = 0;
      control.executedSubsteps = control.executedIterations = control.executedBuilds = control.executedBlocks =
          control.executedNoiseDampings = 0;
      control.timeDropped = 0;
      s.control = records<uint32_t>(std::as_bytes(std::span(&control, 1)), sizeof control / 4);
      s.sums = records<uint32_t>(data[1], sizeof(FluidSums) / 4);
      if (fluid_.setup.movingSolids) {
        for (const SolidRecord& r : records<SolidRecord>(data[2], fluid_.setup.params.solidCount))
          s.solids.insert(s.solids.end(), {r.centerX, r.centerY, r.centerZ, r.velocityX, r.velocityY, r.velocityZ});
      }
      plan();
      break;
    }
    case kPosition:
      s.position = vectors(data[0], n);
      break;
    case kVelocity:
      s.velocity = vectors(data[0], n);
      break;
    case kPush:
      s.push = records<Float4>(data[0], n);
      break;
    case kWarm:
      s.warm = records<float>(data[0], n);
      break;
    case kId:
      s.id = records<uint32_t>(data[0], n);
      break;
    case kNear: {
      FluidSums sums;
      std::memcpy(&sums, s.sums.data(), sizeof sums);
      const auto all = records<uint32_t>(data[0], n);
      const std::span<const uint32_t> both(all);
      if (uint64_t{sums.planeCount} + sums.cornerCount > n)
        return Error{ErrorKind::Failed, "reading the state back: its counts make no sense"};
      s.nearWall = sorted(both.first(sums.planeCount));
      s.nearMore = sorted(both.last(sums.cornerCount));
      break;
    }
    case kCounts: {
      s.neighborCount = records<uint32_t>(data[0], n);
      uint64_t entries = 0;
      for (uint32_t k : s.neighborCount) entries += k <= s.listCapacity ? k : 0;
      s.neighbors.reserve(entries);
      break;
    }
    case kCells:
      s.cell = records<uint32_t>(data[0], n);
      break;
    default: {
      const Chunk& chunk = fluid_.chunks()[part - kLists];
      gatherList(s, chunk.first, chunk.last, records<uint32_t>(data[0], data[0].size() / 4));
    }
  }
  return {};
}

/// What else there is to read follows from the control block.
void SnapshotReader::plan() {
  snapshot_.listCapacity = fluid_.setup.params.listCapacity;
  parts_.insert(parts_.end(), {kPosition, kVelocity, kId});
  if (fluid_.setup.warm) parts_.insert(parts_.end(), {kPush, kWarm});
  if (fluid_.setup.near) parts_.push_back(kNear);
  if (!hasNeighbors(snapshot_)) return;
  if (walksGrid(snapshot_)) parts_.push_back(kCells);
  if (snapshot_.listCapacity == 0) return;
  parts_.push_back(kCounts);
  for (uint32_t c = 0; c < fluid_.chunks().size(); ++c) parts_.push_back(kLists + c);
}

}  // namespace rill
