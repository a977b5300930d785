#include "sort/radix_sort.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "gpu/module_pipelines.hpp"
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
  ModulePipelines pipelines(device);
  sort.count_ = pipelines.make("sort/radix_count");
  for (uint32_t pass = 0; pass < sort.passes_; ++pass)
    sort.scatter_[pass] =
        pipelines.make(std::string("sort/radix_scatter") + (pass == 0 ? "_first" : "") + (sort.writesKeys(pass) ? "_keys" : ""));
  if (desc.start) sort.start_ = pipelines.make("sort/start");
  if (auto made = pipelines.result(); !made) return made.error();
  return sort;
}

bool RadixSort::writesKeys(uint32_t pass) const { return pass + 1 < passes_ || desc_.keys || desc_.start; }
uint64_t RadixSort::startGroups() const { return divideUp(desc_.keyRange + 1, kCountThreads); }

std::vector<GatedDispatch> RadixSort::dispatches() const {
  if (desc_.count == 0) return {};
  std::vector<GatedDispatch> all;
  for (uint32_t pass = 0; pass < passes_; ++pass) {
    all.push_back({foldGroups(tiles_)});
    for (const GroupCount& groups : scan_.groups()) all.push_back({groups});
    all.push_back({foldGroups(tiles_)});
  }
  if (desc_.start) all.push_back({foldGroups(startGroups())});
  return all;
}

SortedKeys RadixSort::addTo(Graph& graph, BufferRef keys, const SortTargets& targets, const Gate* gate) const {
  if (desc_.count == 0) return {targets.order, targets.start, targets.keys, {}};
  Dispatches dispatches(gate);
  // Each pass creates its own transients; aliasing reduces them to two alternating buffers.
  BufferRef order;
  for (uint32_t p = 0; p < passes_; ++p) {
    const bool last = p + 1 == passes_;
    const RadixPush push{desc_.count, tiles_, p * bits_, 1u << bits_};
    BufferRef histogram = graph.create("sort histogram", {paddedWords(uint64_t{tiles_} << bits_) * sizeof(uint32_t)});
    addDispatch(graph, "sort/radix count", count_, dispatches.next(tiles_), push, {{"keys", keys}, {"histogram", histogram}});
    const Gate inner = dispatches.inner(static_cast<uint32_t>(scan_.groups().size()));
    histogram = scan_.addTo(graph, histogram, gate ? &inner : nullptr);
    BufferRef orderOut = targetOr(graph, last ? targets.order : BufferRef{}, "sort order", desc_.count);
    BufferRef keysOut =
        writesKeys(p) ? targetOr(graph, last && desc_.keys ? targets.keys : BufferRef{}, "sort keys", desc_.count) : BufferRef{};
    addDispatch(graph, "sort/radix scatter", scatter_[p], dispatches.next(tiles_), push,
                {{"keys", keys},
                 {"order", std::as_const(order)},
                 {"offsets", histogram},
                 discardUnless(gate, {"orderOut", orderOut}),
                 discardUnless(gate, {"keysOut", keysOut})});
    keys = keysOut;
    order = orderOut;
  }
  BufferRef start;
  if (desc_.start) {
    start = targetOr(graph, targets.start, "sort start", paddedWords(desc_.keyRange + 1));
    addDispatch(graph, "sort/start", start_, dispatches.next(startGroups()), StartPush{desc_.count, static_cast<uint32_t>(desc_.keyRange)},
                {{"keys", keys}, discardUnless(gate, {"start", start})});
  }
  return {order, start, desc_.keys ? keys : BufferRef{}, {}};
}

}  // namespace rill
