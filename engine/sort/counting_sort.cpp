#include "sort/counting_sort.hpp"

#include <algorithm>
#include <optional>

#include "gpu/texel_reads.hpp"
#include "sort/pipelines.hpp"

namespace rill {
Expected<CountingSort> CountingSort::create(Device& device, const KeySortDesc& desc) {
  CountingSort sort;
  sort.desc_ = desc;
  if (desc.count == 0) return sort;
  auto scan = Scan::create(device, static_cast<uint32_t>(desc.keyRange) + 1, desc.storageReads);
  if (!scan) return scan.error();
  sort.scan_ = *scan;
  using enum BindingKind;
  const bool texels = !desc.storageReads && usesTexelReads(device, std::max<uint64_t>(desc.count, paddedWords(desc.keyRange + 1)));
  const uint32_t oversized = sort.binsMayBeOversized() ? 1 : 0;
  ModulePipelines pipelines(device, sizeof(CountingPush));
  sort.texels_ = texels;
  sort.clear_ = pipelines.make("sort/clear", 2);
  if (!desc.fusedEnds) sort.count_ = pipelines.makeReading("sort/count", texels, {TexelUint, Storage, Storage, Storage}, {oversized, 1});
  sort.scatter_ = pipelines.makeReading("sort/scatter", texels, {TexelUint, TexelUint, TexelUint, Storage});
  if (!desc.fusedEnds)
    sort.orderBins_ = pipelines.makeReading("sort/order_bins", texels, {TexelUint, TexelUint, TexelUint, Storage, Storage},
                                            {desc.keys ? 1u : 0u, oversized});
  if (oversized) sort.orderOversized_ = pipelines.makeReading("sort/order_oversized", texels, {TexelUint, TexelUint, Storage, Storage});
  if (auto made = pipelines.result(); !made) return made.error();
  return sort;
}

bool CountingSort::binsMayBeOversized() const { return desc_.count > kBinLimit; }
uint32_t CountingSort::chunks() const { return (desc_.count + kChunkIndices - 1) / kChunkIndices; }
uint64_t CountingSort::clearGroups() const { return divideUp(paddedWords(desc_.keyRange + 1) / 4, kCountThreads * kClearItems); }
uint64_t CountingSort::countGroups() const { return divideUp(desc_.count, kCountThreads); }
uint32_t CountingSort::binGroups() const { return std::min(desc_.count / (kBinLimit + 1), kOversizedGroups); }
uint64_t CountingSort::oversizedGroups() const { return uint64_t{chunks()} * binGroups(); }

CountingPush CountingSort::push() const { return {desc_.count, static_cast<uint32_t>(desc_.keyRange - 1), chunks(), binGroups()}; }

std::vector<GroupCount> CountingSort::groups() const {
  if (desc_.count == 0) return {};
  std::vector<GroupCount> all{foldGroups(clearGroups())};
  if (count_) all.push_back(foldGroups(countGroups()));
  for (const GroupCount& groups : scan_.groups()) all.push_back(groups);
  all.push_back(foldGroups(countGroups()));  // scatter
  if (orderBins_) all.push_back(foldGroups(countGroups()));
  if (orderOversized_) all.push_back(foldGroups(oversizedGroups()));
  return all;
}

// A target must keep its content if the gate skips the dispatches; a transient has none.
static bool discards(BufferRef target, const Gate* gate) { return !gate || target == BufferRef{}; }

SortedKeys CountingSort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys, {}};
  KeyCounters counters = begin(graph, targets, gate);
  graph.pass("sort/count", [&](Pass& pass) {
    Dispatches dispatches(gate, 1);
    pass.read(keys, readUse(texels_));
    counters.start = pass.write(counters.start, Use::ComputeWrite);
    counters.rank = pass.write(counters.rank, Use::ComputeWrite, true);
    counters.oversized = pass.write(counters.oversized, Use::ComputeWrite);
    return dispatches.next(pass, pass.kernel(count_, {keys, counters.start, counters.rank, counters.oversized}), countGroups(), push());
  });
  return finish(graph, keys, counters, targets, gate);
}

KeyCounters CountingSort::begin(Graph& graph, const SortTargets& targets, const Gate* gate) const {
  const uint64_t count = desc_.count;
  if (count == 0) return {};
  KeyCounters counters{targetOr(graph, targets.start, "sort start", paddedWords(desc_.keyRange + 1)),
                       graph.create("sort ranks", {count * sizeof(uint32_t)}),
                       graph.create("sort oversized bins", {(count / (kBinLimit + 1) + 2) * sizeof(uint32_t)})};
  graph.pass("sort/clear", [&](Pass& pass) {
    Dispatches dispatches(gate);
    counters.start = pass.write(counters.start, Use::ComputeWrite, discards(targets.start, gate));
    counters.oversized = pass.write(counters.oversized, Use::ComputeWrite, true);
    return dispatches.next(pass, pass.kernel(clear_, {counters.start, counters.oversized}), clearGroups(), push());
  });
  return counters;
}

SortedKeys CountingSort::finish(Graph& graph, BufferRef keys, const KeyCounters& counters, const SortTargets& targets,
                                const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys, {}};
  const Use read = readUse(texels_);
  Dispatches dispatches(gate, count_ ? 2 : 1);
  BufferRef start = counters.start, arrived = graph.create("sort arrived", {desc_.count * sizeof(uint32_t)});
  if (gate) {
    const Gate inner = dispatches.inner(static_cast<uint32_t>(scan_.groups().size()));
    start = scan_.addTo(graph, start, &inner);
  } else {
    start = scan_.addTo(graph, start);
  }
  graph.pass("sort/scatter", [&](Pass& pass) {
    for (BufferRef ref : {keys, start, counters.rank}) pass.read(ref, read);
    arrived = pass.write(arrived, Use::ComputeWrite, true);
    return dispatches.next(pass, pass.kernel(scatter_, {keys, start, counters.rank, arrived}), countGroups(), push());
  });
  if (!orderBins_ && !orderOversized_) return {arrived, start, {}, arrived};
  BufferRef order = targetOr(graph, targets.order, "sort order", desc_.count);
  BufferRef sortedKeys = desc_.keys ? targetOr(graph, targets.keys, "sort keys", desc_.count) : BufferRef{};
  // One dispatch for bins up to kBinLimit, one for larger bins; they write disjoint ranges.
  graph.pass("sort/order bins", [&](Pass& pass) {
    if (orderBins_) pass.read(keys, read);
    for (BufferRef ref : {start, arrived}) pass.read(ref, read);
    if (orderOversized_) pass.read(counters.oversized, Use::ComputeRead);
    order = pass.write(order, Use::ComputeWrite, discards(targets.order, gate));
    if (desc_.keys) sortedKeys = pass.write(sortedKeys, Use::ComputeWrite, discards(targets.keys, gate));
    const BufferRef keysOrUnused = desc_.keys ? sortedKeys : order;
    std::optional<Dispatch<CountingPush>> bins, large;
    if (orderBins_)
      bins = dispatches.next(pass, pass.kernel(orderBins_, {keys, start, arrived, order, keysOrUnused}), countGroups(), push());
    if (orderOversized_)
      large = dispatches.next(pass, pass.kernel(orderOversized_, {start, arrived, order, counters.oversized}), oversizedGroups(), push());
    return [bins, large](Commands& commands) {
      if (bins) (*bins)(commands);
      if (large) (*large)(commands);
    };
  });
  return {order, start, sortedKeys, desc_.fusedEnds ? arrived : BufferRef{}};
}

}  // namespace rill
