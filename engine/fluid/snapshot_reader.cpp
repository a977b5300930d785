// A fluid's state from the device, buffer by buffer.
#include <algorithm>
#include <cstring>

#include "fluid/fluid_impl.hpp"
#include "fluid/near_solids.hpp"
#include "fluid/neighbor_list.hpp"
#include "fluid/sleep.hpp"
#include "fluid/snapshot.hpp"
#include "graph/import_whole.hpp"
#include "shape/records.hpp"

namespace rill {
namespace {

/// What is read after the records and the saved arrays, each in a graph of its own. A part is a slot of the fluid's buffers.
constexpr uint32_t kRecords = kSlots;

template <class Record>
std::vector<Record> records(std::span<const std::byte> bytes, size_t count) {
  std::vector<Record> all(count);
  std::memcpy(all.data(), bytes.data(), count * sizeof(Record));
  return all;
}

/// An array of the device, whose vectors of three have four components.
template <class Element>
void read(std::span<const std::byte> bytes, size_t count, std::vector<Element>& all) {
  constexpr size_t stride = std::is_same_v<Element, Float3> ? sizeof(Float4) : sizeof(Element);
  all.resize(count);
  for (size_t i = 0; i < count; ++i) std::memcpy(&all[i], bytes.data() + stride * i, sizeof(Element));
}

}  // namespace

SnapshotReader::SnapshotReader(const Fluid& fluid) : fluid_(implOf(fluid)) {
  if (fluid_.capacity > 0) parts_ = {kRecords};
}

bool SnapshotReader::done() const { return next_ == parts_.size(); }

void SnapshotReader::declare(Graph& graph) {
  tickets_.clear();
  const auto read = [&](size_t slot) { tickets_.push_back(graph.readback(importWhole(graph, "state", fluid_.slot(slot)))); };
  const uint32_t part = parts_[next_];
  if (part != kRecords) return read(part);
  for (FluidArray array :
       {FluidArray::Control, FluidArray::Sums, FluidArray::Solids, FluidArray::SolidLoads, FluidArray::Bodies, FluidArray::Slips,
        FluidArray::PressureProbes, FluidArray::Flow, FluidArray::Emitters, FluidArray::Drains, FluidArray::Regions})
    read(slotOf(array));
}

Expected<void> SnapshotReader::take(const Graph& graph) {
  std::vector<std::span<const std::byte>> data;
  for (Ticket ticket : tickets_) {
    data.push_back(graph.data(ticket));
    if (data.back().empty()) return Error{ErrorKind::Failed, "reading the state back: no data came back"};
  }
  FluidSnapshot& s = snapshot_;
  const uint32_t part = parts_[next_++];
  if (part == kRecords) {
    takeRecords(data);
    plan();
    return {};
  }
  const uint32_t n = s.control.front();  // FluidControl::count
  const std::span<const std::byte> bytes = data[0];
  bool saved = false;
  forEachSaved([&](const ArrayRow& row, auto member) {
    if (slotOf(row.id) != part) return;
    saved = true;
    read(bytes, n, s.*member);
  });
  if (part == slotOf(FluidArray::Position) && fluid_.setup.fluids > 1)
    for (const Float4& position : records<Float4>(bytes, n)) s.fluid.push_back(static_cast<uint8_t>(position.w));
  if (saved) return {};
  if (part == slotOf(FluidArray::NearSolids)) {
    FluidSums sums;
    std::memcpy(&sums, s.sums.data(), sizeof sums);
    if (sums.nearSolids > n) return Error{ErrorKind::Failed, "reading the state back: its counts make no sense"};
    const uint32_t quads = nearSolidQuads(fluid_.setup.params.solidCount);
    s.nearSolids = gatherNearSolids(records<uint32_t>(bytes, size_t{4} * quads * sums.nearSolids), quads);
    // Theirs is the order in which threads met, which no bit depends on; a file should not, either.
    std::ranges::sort(s.nearSolids, {}, &NearSolids::particle);
  } else if (part == slotOf(FluidArray::ListHead)) {
    heads_ = records<uint32_t>(bytes, n);
    s.neighborCount.reserve(n);
    uint64_t entries = 0;
    for (const uint32_t head : heads_) entries += (head & kUnlisted) <= s.listCapacity ? head & kUnlisted : 0;
    s.neighbors.reserve(entries);
  } else if (part == slotOf(FluidArray::Cell)) {
    s.cell = records<uint32_t>(bytes, n);
  } else {
    const uint32_t c = part == slotOf(FluidArray::List) ? 0 : part - static_cast<uint32_t>(kArrays) + 1;
    const Chunk& chunk = fluid_.chunks()[c];
    gatherList(s, chunk.first, chunk.last, heads_, records<uint32_t>(bytes, bytes.size() / 4));
  }
  return {};
}

// Of the advance before, the next one begins with no count.
void SnapshotReader::takeRecords(std::span<const std::span<const std::byte>> data) {
  FluidControl control;
  std::memcpy(&control, data[0].data(), sizeof control);
  control.substeps = control.iterations = control.builds = 0;
  control.executedSubsteps = control.executedIterations = control.executedBuilds = control.executedNoiseDampings = 0;
  control.executedDiffusions = 0;
  control.executedFallsAsleep = 0;
  control.timeAsleep = 0;
  control.timeDropped = 0;
  control.pulls = 0;
  snapshot_.control = records<uint32_t>(std::as_bytes(std::span(&control, 1)), sizeof control / 4);
  snapshot_.sums = records<uint32_t>(data[1], sizeof(FluidSums) / 4);
  if (fluid_.setup.loads) snapshot_.loads = records<float>(data[3], fluid_.setup.params.solidCount * kLoadNumbers);
  if (fluid_.setup.params.bodyCount > 0) snapshot_.bodies = records<uint32_t>(data[4], fluid_.setup.params.bodyCount * kBodyWords);
  if (fluid_.setup.params.bodyCount > 0) snapshot_.slips = records<uint32_t>(data[5], fluid_.setup.params.contactPoints * kSlipWords);
  snapshot_.pressures = records<uint32_t>(data[6], fluid_.setup.pressureProbes.size() * kPressureProbeWords);
  const auto addFlows = [&](std::span<const std::byte> from, size_t bytes) {
    const auto words = records<uint32_t>(from, bytes / 4);
    snapshot_.flows.insert(snapshot_.flows.end(), words.begin(), words.end());
  };
  if (fluid_.setup.removes) {
    addFlows(data[7], sizeof(FlowRecord));
    addFlows(data[8], fluid_.setup.emitters.size() * sizeof(EmitterRecord));
    addFlows(data[9], fluid_.setup.drains.size() * sizeof(DrainRecord));
  }
  snapshot_.regions = records<uint32_t>(data[10], regionCount(fluid_.setup.params) * kRegionWords);
  if (!fluid_.setup.movingSolids) return;
  for (const SolidRecord& r : records<SolidRecord>(data[2], fluid_.setup.params.solidCount)) appendPose(r.pose, snapshot_.solids);
}

/// What else there is to read follows from the control block.
void SnapshotReader::plan() {
  snapshot_.listCapacity = fluid_.setup.params.listCapacity;
  const auto add = [&](FluidArray array, uint32_t chunk = 0) { parts_.push_back(static_cast<uint32_t>(slotOf(array, chunk))); };
  const ArrayShape shape = arrayShape(fluid_.setup);
  forEachSaved([&](const ArrayRow& row, auto) {
    if (row.length(shape) > 0) add(row.id);
  });
  if (fluid_.setup.params.solidCount > 0) add(FluidArray::NearSolids);
  if (!hasNeighbors(snapshot_)) return;
  add(FluidArray::Cell);
  if (snapshot_.listCapacity == 0) return;
  add(FluidArray::ListHead);
  for (uint32_t c = 0; c < fluid_.chunks().size(); ++c) add(FluidArray::List, c);
}

}  // namespace rill
