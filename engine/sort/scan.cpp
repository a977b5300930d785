#include "sort/scan.hpp"

#include <string>

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "sort/sort_types.h"

namespace rill {
namespace {

/// Up to this many values, one workgroup is faster than two dispatches.
constexpr uint32_t kSingleCount = 8 * kScanTile;

uint32_t tileCount(uint32_t count) { return (count + kScanTile - 1) / kScanTile; }

}  // namespace

Expected<Scan> Scan::create(Device& device, uint32_t count, bool storageReads, const ScanNames& names) {
  if (count > kMaxCount)
    return Error{ErrorKind::BadInput, "scan: " + std::to_string(count) + " values; expected at most " + std::to_string(kMaxCount)};
  Scan scan;
  scan.count_ = count;
  scan.names_ = names;
  if (count == 0) return scan;
  static_assert(kMaxCount / 4 <= kReadTexels);
  const bool texels = !storageReads && usesTexelReads(device);
  ModulePipelines pipelines(device);
  const SubgroupNeed full = fullSubgroups(device.info(), kScanThreads);  // see workgroup_scan.glsl
  scan.pipelines_ = {pipelines.make("sort/scan_single", false, {}, full), pipelines.make("sort/scan_reduce", texels, {}, full),
                     pipelines.make("sort/scan_apply", texels, {{"SUMS_SCANNED", false}}, full),
                     pipelines.make("sort/scan_apply", texels, {{"SUMS_SCANNED", true}}, full)};
  if (auto made = pipelines.result(); !made) return made.error();
  return scan;
}

std::vector<GroupCount> Scan::groups() const {
  if (count_ == 0) return {};
  const uint32_t tiles = tileCount(count_);
  if (count_ <= kSingleCount) return {foldGroups(1)};
  if (tiles <= kScanSums) return {foldGroups(tiles), foldGroups(tiles)};
  return {foldGroups(tiles), foldGroups(1), foldGroups(tiles)};
}

BufferRef Scan::addTo(Graph& graph, BufferRef values, const Gate* gate) const {
  if (count_ == 0) return values;
  Dispatches dispatches(gate);
  if (count_ <= kSingleCount) {
    addDispatch(graph, names_.single, pipelines_.single, dispatches.next(1), ScanPush{count_}, {{"values", values}});
    return values;
  }
  const uint32_t tiles = tileCount(count_);
  BufferRef sums = graph.create("scan tile sums", {paddedWords(tiles) * sizeof(uint32_t)});
  addDispatch(graph, names_.reduce, pipelines_.reduce, dispatches.next(tiles), ScanPush{count_}, {{"values", values}, {"tileSums", sums}});
  const bool scanned = tiles > kScanSums;
  if (scanned) addDispatch(graph, names_.tiles, pipelines_.single, dispatches.next(1), ScanPush{tiles}, {{"values", sums}});
  addDispatch(graph, names_.apply, scanned ? pipelines_.applyScanned : pipelines_.apply, dispatches.next(tiles), ScanPush{count_},
              {{"values", values}, {"tileSums", sums}});
  return values;
}

}  // namespace rill
