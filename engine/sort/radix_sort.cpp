#include "sort/radix_sort.hpp"

#include <algorithm>
#include <bit>

#include "sort/pipelines.hpp"
#include "sort/sort_types.h"

namespace rill {
Expected<RadixSort> RadixSort::create(Device& device, const KeySortDesc& desc) {
  RadixSort sort;
  sort.desc_ = desc;
  if (desc.count == 0) return sort;
  // Even a range of one key needs a pass, to write the order.
  const uint32_t keyBits = std::max(1u, static_cast<uint32_t>(std::bit_width(desc.keyRange - 1)));
  sort.passes_ = (keyBits + kRadixBits - 1) / kRadixBits;
  sort.bits_ = (keyBits + sort.passes_ - 1) / sort.passes_;  // evenly, since fewer digit values make a pass cheaper
  sort.tiles_ = (desc.count + kRadixTile - 1) / kRadixTile;
  auto scan = Scan::create(device, sort.tiles_ << sort.bits_, desc.storageReads);
  if (!scan) return scan.error();
  sort.scan_ = *scan;
  ModulePipelines pipelines(device, sizeof(RadixPush));
  sort.count_ = pipelines.make("sort/radix_count", 2);
  for (uint32_t pass = 0; pass < sort.passes_; ++pass)
    sort.scatter_[pass] = pipelines.make("sort/radix_scatter", 5, {pass == 0 ? 1u : 0u, sort.writesKeys(pass) ? 1u : 0u});
  if (auto made = pipelines.result(); !made) return made.error();
  if (desc.start) {
    ModulePipelines startPipelines(device, sizeof(StartPush));
    sort.start_ = startPipelines.make("sort/start", 2);
    if (auto made = startPipelines.result(); !made) return made.error();
  }
  return sort;
}

bool RadixSort::writesKeys(uint32_t pass) const { return pass + 1 < passes_ || desc_.keys || desc_.start; }
uint64_t RadixSort::startGroups() const { return divideUp(desc_.keyRange + 1, kCountThreads); }

std::vector<GroupCount> RadixSort::groups() const {
  if (desc_.count == 0) return {};
  std::vector<GroupCount> all;
  for (uint32_t pass = 0; pass < passes_; ++pass) {
    all.push_back(foldGroups(tiles_));
    for (const GroupCount& groups : scan_.groups()) all.push_back(groups);
    all.push_back(foldGroups(tiles_));
  }
  if (desc_.start) all.push_back(foldGroups(startGroups()));
  return all;
}

SortedKeys RadixSort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys, {}};
  Dispatches dispatches(gate);
  // A target must keep its content if the gate skips the dispatches; a transient has none.
  const auto discard = [&](BufferRef target) { return !gate || target == BufferRef{}; };

  // Each pass creates its own transients; aliasing reduces them to two alternating buffers.
  BufferRef order;
  for (uint32_t p = 0; p < passes_; ++p) {
    const bool first = p == 0, last = p + 1 == passes_;
    const RadixPush push{desc_.count, tiles_, p * bits_, 1u << bits_};
    BufferRef histogram = graph.create("sort histogram", {paddedWords(uint64_t{tiles_} << bits_) * sizeof(uint32_t)});
    graph.pass("sort/radix count", [&](Pass& pass) {
      pass.read(keys, Use::ComputeRead);
      histogram = pass.write(histogram, Use::ComputeWrite, true);
      return dispatches.next(pass, pass.kernel(count_, {keys, histogram}), tiles_, push);
    });
    if (gate) {
      const Gate inner = dispatches.inner(static_cast<uint32_t>(scan_.groups().size()));
      histogram = scan_.addTo(graph, histogram, &inner);
    } else {
      histogram = scan_.addTo(graph, histogram);
    }
    const BufferRef orderTarget = last ? targets.order : BufferRef{};
    const BufferRef keysTarget = last && desc_.keys ? targets.keys : BufferRef{};
    BufferRef orderOut = targetOr(graph, orderTarget, "sort order", desc_.count);
    BufferRef keysOut = writesKeys(p) ? targetOr(graph, keysTarget, "sort keys", desc_.count) : BufferRef{};
    graph.pass("sort/radix scatter", [&](Pass& pass) {
      pass.read(keys, Use::ComputeRead);
      if (!first) pass.read(order, Use::ComputeRead);
      pass.read(histogram, Use::ComputeRead);
      orderOut = pass.write(orderOut, Use::ComputeWrite, discard(orderTarget));
      if (writesKeys(p)) keysOut = pass.write(keysOut, Use::ComputeWrite, discard(keysTarget));
      // Bindings that this variant does not use get an arbitrary declared buffer.
      const BufferRef orderOrUnused = first ? keys : order, keysOrUnused = writesKeys(p) ? keysOut : orderOut;
      return dispatches.next(pass, pass.kernel(scatter_[p], {keys, orderOrUnused, histogram, keysOrUnused, orderOut}), tiles_, push);
    });
    keys = keysOut;
    order = orderOut;
  }
  BufferRef start;
  if (desc_.start) {
    start = targetOr(graph, targets.start, "sort start", paddedWords(desc_.keyRange + 1));
    graph.pass("sort/start", [&](Pass& pass) {
      pass.read(keys, Use::ComputeRead);
      start = pass.write(start, Use::ComputeWrite, discard(targets.start));
      return dispatches.next(pass, pass.kernel(start_, {keys, start}), startGroups(),
                             StartPush{desc_.count, static_cast<uint32_t>(desc_.keyRange)});
    });
  }
  return {order, start, desc_.keys ? keys : BufferRef{}, {}};
}

}  // namespace rill
