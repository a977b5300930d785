#include "sort/counting_sort.hpp"

#include <algorithm>

#include "sort/pipelines.hpp"
#include "sort/sort_types.h"

namespace rill {
Expected<CountingSort> CountingSort::create(Device& device, const KeySortDesc& desc) {
  CountingSort sort;
  sort.desc_ = desc;
  if (desc.count == 0) return sort;
  auto scan = Scan::create(device, static_cast<uint32_t>(desc.keyRange) + 1);
  if (!scan) return scan.error();
  sort.scan_ = *scan;
  const uint32_t oversized = sort.binsMayBeOversized() ? 1 : 0;
  StoragePipelines pipelines(device, sizeof(CountingPush));
  sort.clear_ = pipelines.make("sort/clear", 2);
  sort.count_ = pipelines.make("sort/count", 3);
  sort.scatter_ = pipelines.make("sort/scatter", 4);
  sort.orderBins_ = pipelines.make("sort/order_bins", 7, {desc.keys ? 1u : 0u, oversized});
  if (oversized) sort.orderOversized_ = pipelines.make("sort/order_oversized", 4);
  if (auto made = pipelines.result(); !made) return made.error();
  return sort;
}

bool CountingSort::binsMayBeOversized() const { return desc_.count > kBinLimit; }
uint64_t CountingSort::clearGroups() const { return divideUp(desc_.keyRange + 1, kCountThreads * kClearItems); }
uint64_t CountingSort::countGroups() const { return divideUp(desc_.count, kCountThreads); }

std::vector<GroupCount> CountingSort::groups() const {
  if (desc_.count == 0) return {};
  std::vector<GroupCount> all{foldGroups(clearGroups()), foldGroups(countGroups())};
  for (const GroupCount& groups : scan_.groups()) all.push_back(groups);
  all.push_back(foldGroups(countGroups()));  // scatter
  all.push_back(foldGroups(countGroups()));  // order
  return all;
}

SortedKeys CountingSort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys};
  const uint32_t count = desc_.count;
  const CountingPush push{count, static_cast<uint32_t>(desc_.keyRange - 1), (count + kChunkIndices - 1) / kChunkIndices};
  Dispatches dispatches(gate);
  // Behind a closed gate a target keeps what it holds; a transient holds nothing.
  const auto discard = [&](BufferRef target) { return !gate || target == BufferRef{}; };
  const bool oversizedFilled = gate && binsMayBeOversized();

  BufferRef start = targetOr(graph, targets.start, "sort start", desc_.keyRange + 1);
  BufferRef order = targetOr(graph, targets.order, "sort order", count);
  BufferRef sortedKeys = desc_.keys ? targetOr(graph, targets.keys, "sort keys", count) : BufferRef{};
  BufferRef arrived = graph.create("sort arrived", {count * sizeof(uint32_t)});
  BufferRef oversizedGroups = graph.create("sort oversized groups", {sizeof(VkDispatchIndirectCommand)});
  BufferRef oversizedBins = graph.create("sort oversized bins", {(count / (kBinLimit + 1) + 1) * sizeof(uint32_t)});

  if (oversizedFilled) {
    // The dispatch that these size is not behind the gate, so behind a closed one they must be there, and zero.
    graph.pass("sort/no oversized", [&](Pass& pass) {
      oversizedGroups = pass.write(oversizedGroups, Use::CopyTarget, true);
      return [oversizedGroups](Commands& commands) { commands.fill(oversizedGroups, 0); };
    });
  }
  graph.pass("sort/clear", [&](Pass& pass) {
    start = pass.write(start, Use::ComputeWrite, discard(targets.start));
    oversizedGroups = pass.write(oversizedGroups, Use::ComputeWrite, !oversizedFilled);
    return dispatches.next(pass, pass.kernel(clear_, {start, oversizedGroups}), clearGroups(), push);
  });
  graph.pass("sort/count", [&](Pass& pass) {
    pass.read(keys, Use::ComputeRead);
    start = pass.write(start, Use::ComputeWrite);
    order = pass.write(order, Use::ComputeWrite, discard(targets.order));  // holds the ranks of arrival until the last step
    return dispatches.next(pass, pass.kernel(count_, {keys, start, order}), countGroups(), push);
  });
  if (gate) {
    const Gate inner = dispatches.inner(static_cast<uint32_t>(scan_.groups().size()));
    start = scan_.addTo(graph, start, &inner);
  } else {
    start = scan_.addTo(graph, start);
  }
  graph.pass("sort/scatter", [&](Pass& pass) {
    pass.read(keys, Use::ComputeRead);
    pass.read(start, Use::ComputeRead);
    pass.read(order, Use::ComputeRead);
    arrived = pass.write(arrived, Use::ComputeWrite, true);
    return dispatches.next(pass, pass.kernel(scatter_, {keys, start, order, arrived}), countGroups(), push);
  });
  graph.pass("sort/order bins", [&](Pass& pass) {
    pass.read(keys, Use::ComputeRead);
    pass.read(start, Use::ComputeRead);
    pass.read(arrived, Use::ComputeRead);
    order = pass.write(order, Use::ComputeWrite, discard(targets.order));
    if (desc_.keys) sortedKeys = pass.write(sortedKeys, Use::ComputeWrite, discard(targets.keys));
    oversizedGroups = pass.write(oversizedGroups, Use::ComputeWrite);
    oversizedBins = pass.write(oversizedBins, Use::ComputeWrite, true);
    const BufferRef keysOrUnused = desc_.keys ? sortedKeys : order;
    return dispatches.next(pass, pass.kernel(orderBins_, {keys, start, arrived, order, keysOrUnused, oversizedGroups, oversizedBins}),
                           countGroups(), push);
  });
  if (binsMayBeOversized()) {
    graph.pass("sort/order oversized", [&](Pass& pass) {
      pass.read(oversizedGroups, Use::Indirect);
      pass.read(start, Use::ComputeRead);
      pass.read(arrived, Use::ComputeRead);
      pass.read(oversizedBins, Use::ComputeRead);
      order = pass.write(order, Use::ComputeWrite);
      const Kernel kernel = pass.kernel(orderOversized_, {start, arrived, order, oversizedBins});
      return [=](Commands& commands) { commands.dispatchIndirect(kernel, oversizedGroups, 0, push); };
    });
  }
  return {order, start, sortedKeys};
}

}  // namespace rill
