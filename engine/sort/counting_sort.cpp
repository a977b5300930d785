#include "sort/counting_sort.hpp"

#include <algorithm>
#include <optional>

#include "sort/pipelines.hpp"
#include "sort/sort_types.h"

namespace rill {
Expected<CountingSort> CountingSort::create(Device& device, const KeySortDesc& desc) {
  CountingSort sort;
  sort.desc_ = desc;
  if (desc.count == 0) return sort;
  auto scan = Scan::create(device, static_cast<uint32_t>(desc.keyRange) + 1, desc.storageReads);
  if (!scan) return scan.error();
  sort.scan_ = *scan;
  using enum BindingKind;
  const bool texels =
      !desc.storageReads && device.info().maxTexelBufferElements >= std::max<uint64_t>(desc.count, paddedWords(desc.keyRange + 1));
  const uint32_t oversized = sort.binsMayBeOversized() ? 1 : 0;
  ModulePipelines pipelines(device, sizeof(CountingPush));
  sort.texels_ = texels;
  sort.clear_ = pipelines.make("sort/clear", 2);
  sort.count_ = pipelines.makeReading("sort/count", texels, {TexelUint, Storage, Storage, Storage}, {oversized});
  sort.scatter_ = pipelines.makeReading("sort/scatter", texels, {TexelUint, TexelUint, TexelUint, Storage});
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

std::vector<GroupCount> CountingSort::groups() const {
  if (desc_.count == 0) return {};
  std::vector<GroupCount> all{foldGroups(clearGroups()), foldGroups(countGroups())};
  for (const GroupCount& groups : scan_.groups()) all.push_back(groups);
  all.push_back(foldGroups(countGroups()));  // scatter
  all.push_back(foldGroups(countGroups()));  // order
  if (binsMayBeOversized()) all.push_back(foldGroups(oversizedGroups()));
  return all;
}

SortedKeys CountingSort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys};
  const uint32_t count = desc_.count;
  const CountingPush push{count, static_cast<uint32_t>(desc_.keyRange - 1), chunks(), binGroups()};
  const Use read = readUse(texels_);
  Dispatches dispatches(gate);
  // Behind a closed gate a target keeps what it holds; a transient holds nothing.
  const auto discard = [&](BufferRef target) { return !gate || target == BufferRef{}; };

  BufferRef start = targetOr(graph, targets.start, "sort start", paddedWords(desc_.keyRange + 1));
  BufferRef order = targetOr(graph, targets.order, "sort order", count);
  BufferRef sortedKeys = desc_.keys ? targetOr(graph, targets.keys, "sort keys", count) : BufferRef{};
  BufferRef arrived = graph.create("sort arrived", {count * sizeof(uint32_t)});
  BufferRef oversized = graph.create("sort oversized bins", {(count / (kBinLimit + 1) + 2) * sizeof(uint32_t)});

  graph.pass("sort/clear", [&](Pass& pass) {
    start = pass.write(start, Use::ComputeWrite, discard(targets.start));
    oversized = pass.write(oversized, Use::ComputeWrite, true);
    return dispatches.next(pass, pass.kernel(clear_, {start, oversized}), clearGroups(), push);
  });
  graph.pass("sort/count", [&](Pass& pass) {
    pass.read(keys, read);
    start = pass.write(start, Use::ComputeWrite);
    order = pass.write(order, Use::ComputeWrite, discard(targets.order));  // holds the ranks of arrival until the last step
    oversized = pass.write(oversized, Use::ComputeWrite);
    return dispatches.next(pass, pass.kernel(count_, {keys, start, order, oversized}), countGroups(), push);
  });
  if (gate) {
    const Gate inner = dispatches.inner(static_cast<uint32_t>(scan_.groups().size()));
    start = scan_.addTo(graph, start, &inner);
  } else {
    start = scan_.addTo(graph, start);
  }
  graph.pass("sort/scatter", [&](Pass& pass) {
    for (BufferRef ref : {keys, start, order}) pass.read(ref, read);
    arrived = pass.write(arrived, Use::ComputeWrite, true);
    return dispatches.next(pass, pass.kernel(scatter_, {keys, start, order, arrived}), countGroups(), push);
  });
  // Bins of up to kBinLimit and larger ones: two dispatches, which write different places.
  graph.pass("sort/order bins", [&](Pass& pass) {
    for (BufferRef ref : {keys, start, arrived}) pass.read(ref, read);
    if (orderOversized_) pass.read(oversized, Use::ComputeRead);
    order = pass.write(order, Use::ComputeWrite, discard(targets.order));
    if (desc_.keys) sortedKeys = pass.write(sortedKeys, Use::ComputeWrite, discard(targets.keys));
    const BufferRef keysOrUnused = desc_.keys ? sortedKeys : order;
    const auto bins = dispatches.next(pass, pass.kernel(orderBins_, {keys, start, arrived, order, keysOrUnused}), countGroups(), push);
    std::optional<Dispatch<CountingPush>> large;
    if (orderOversized_)
      large = dispatches.next(pass, pass.kernel(orderOversized_, {start, arrived, order, oversized}), oversizedGroups(), push);
    return [bins, large](Commands& commands) {
      bins(commands);
      if (large) (*large)(commands);
    };
  });
  return {order, start, sortedKeys};
}

}  // namespace rill
