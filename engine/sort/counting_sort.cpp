#include "sort/counting_sort.hpp"

#include <algorithm>

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"

namespace rill {
Expected<CountingSort> CountingSort::create(Device& device, const KeySortDesc& desc) {
  CountingSort sort;
  sort.desc_ = desc;
  if (desc.count == 0) return sort;
  auto scan = Scan::create(device, static_cast<uint32_t>(desc.keyRange) + 1, desc.storageReads);
  if (!scan) return scan.error();
  sort.scan_ = *scan;
  const bool texels = !desc.storageReads && usesTexelReads(device, std::max<uint64_t>(desc.count, paddedWords(desc.keyRange + 1)));
  const bool oversized = sort.binsMayBeOversized();
  ModulePipelines pipelines(device);
  sort.clear_ = pipelines.make("sort/clear");
  if (!desc.fusedEnds) sort.count_ = pipelines.make("sort/count", texels, {{"LIST_OVERSIZED", oversized}});
  sort.scatter_ = pipelines.make("sort/scatter", texels, {{"SKIP_NO_KEY", desc.fusedEnds}});
  if (!desc.fusedEnds)
    sort.orderBins_ = pipelines.make(desc.keys ? "sort/order_bins_keys" : "sort/order_bins", texels, {{"SKIP_OVERSIZED", oversized}});
  if (oversized) sort.orderOversized_ = pipelines.make("sort/order_oversized", texels, {}, fullSubgroups(device.info(), kCountThreads));
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

std::vector<GatedDispatch> CountingSort::dispatches() const {
  if (desc_.count == 0) return {};
  const GatedDispatch overKeys{foldGroups(countGroups()), kCountThreads};
  std::vector<GatedDispatch> all{{foldGroups(clearGroups())}};
  if (count_) all.push_back(overKeys);
  for (const GroupCount& groups : scan_.groups()) all.push_back({groups});
  all.push_back(overKeys);  // scatter
  if (orderBins_) all.push_back(overKeys);
  if (orderOversized_) all.push_back({foldGroups(oversizedGroups())});
  return all;
}

SortedKeys CountingSort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys, {}};
  KeyCounters counters = begin(graph, targets, gate);
  Dispatches dispatches(gate, 1);
  addDispatch(graph, "sort/count", count_, dispatches.next(countGroups()), push(),
              {{"key", keys}, {"start", counters.start}, {"rank", counters.rank}, {"oversized", counters.oversized}});
  return finish(graph, keys, counters, targets, gate);
}

KeyCounters CountingSort::begin(Graph& graph, const SortTargets& targets, const Gate* gate) const {
  const uint64_t count = desc_.count;
  if (count == 0) return {};
  KeyCounters counters{targetOr(graph, targets.start, "sort start", paddedWords(desc_.keyRange + 1)),
                       graph.create("sort ranks", {count * sizeof(uint32_t)}),
                       graph.create("sort oversized bins", {(count / (kBinLimit + 1) + 2) * sizeof(uint32_t)})};
  Dispatches dispatches(gate);
  addDispatch(graph, "sort/clear", clear_, dispatches.next(clearGroups()), push(),
              {discardUnless(gate, {"start", counters.start}), {"oversized", counters.oversized}});
  return counters;
}

SortedKeys CountingSort::finish(Graph& graph, BufferRef keys, const KeyCounters& counters, const SortTargets& targets,
                                const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys, {}};
  Dispatches dispatches(gate, count_ ? 2 : 1);
  BufferRef start = counters.start, arrived = graph.create("sort arrived", {desc_.count * sizeof(uint32_t)});
  const Gate inner = dispatches.inner(static_cast<uint32_t>(scan_.groups().size()));
  start = scan_.addTo(graph, start, gate ? &inner : nullptr);
  addDispatch(graph, "sort/scatter", scatter_, dispatches.next(countGroups()), push(),
              {{"key", keys}, {"start", start}, {"rank", counters.rank}, {"arrived", arrived}});
  if (!orderBins_ && !orderOversized_) return {arrived, start, {}, arrived};
  BufferRef order = targetOr(graph, targets.order, "sort order", desc_.count);
  BufferRef sortedKeys = desc_.keys ? targetOr(graph, targets.keys, "sort keys", desc_.count) : BufferRef{};
  // One dispatch for bins up to kBinLimit, one for larger bins; they write disjoint ranges.
  graph.pass("sort/order bins", [&](Pass& pass) {
    if (gate) pass.read(gate->arguments, Use::Indirect);
    const Named ordered = discardUnless(gate, {"order", order});
    struct Sized {
      Kernel kernel;
      DispatchSize size{0};
    } bins, large;
    if (orderBins_)
      bins = {bindNamed(pass, orderBins_,
                        {{"key", keys}, {"start", start}, {"arrived", arrived}, ordered, discardUnless(gate, {"sortedKeys", sortedKeys})}),
              dispatches.next(countGroups())};
    if (orderOversized_)
      large = {bindNamed(pass, orderOversized_, {{"start", start}, {"arrived", arrived}, ordered, {"oversized", counters.oversized}}),
               dispatches.next(oversizedGroups())};
    return [bins, large, push = push()](Commands& commands) {
      dispatch(commands, bins.kernel, bins.size, push);
      dispatch(commands, large.kernel, large.size, push);
    };
  });
  return {order, start, sortedKeys, desc_.fusedEnds ? arrived : BufferRef{}};
}

}  // namespace rill
