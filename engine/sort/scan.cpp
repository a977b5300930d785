#include "sort/scan.hpp"

#include <string>

#include "gpu/texel_reads.hpp"
#include "sort/pipelines.hpp"
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
  using enum BindingKind;
  scan.texels_ = !storageReads && usesTexelReads(device, paddedWords(count) / 4);
  ModulePipelines pipelines(device, sizeof(ScanPush));
  const auto make = [&](bool texels) {
    Pipelines made;
    made.single = pipelines.make("sort/scan_single", 1);
    made.reduce = pipelines.makeReading("sort/scan_reduce", texels, {TexelUint4, Storage});
    made.apply = pipelines.makeReading("sort/scan_apply", texels, {Storage, TexelUint}, {0});
    made.applyScanned = pipelines.makeReading("sort/scan_apply", texels, {Storage, TexelUint}, {1});
    return made;
  };
  scan.pipelines_ = make(scan.texels_);
  if (count == kMaxCount) make(!scan.texels_);  // smaller counts may use the other variant
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
  const Use read = readUse(texels_);
  const auto single = [&](std::string_view name, BufferRef& buffer, uint32_t count) {
    graph.pass(name, [&](Pass& pass) {
      buffer = pass.write(buffer, Use::ComputeWrite);
      return dispatches.next(pass, pass.kernel(pipelines_.single, {buffer}), 1, ScanPush{count});
    });
  };
  if (count_ <= kSingleCount) {
    single(names_.single, values, count_);
    return values;
  }
  const uint32_t tiles = tileCount(count_);
  BufferRef sums = graph.create("scan tile sums", {paddedWords(tiles) * sizeof(uint32_t)});
  graph.pass(names_.reduce, [&](Pass& pass) {
    pass.read(values, read);
    sums = pass.write(sums, Use::ComputeWrite, true);
    return dispatches.next(pass, pass.kernel(pipelines_.reduce, {values, sums}), tiles, ScanPush{count_});
  });
  const bool scanned = tiles > kScanSums;
  if (scanned) single(names_.tiles, sums, tiles);
  graph.pass(names_.apply, [&](Pass& pass) {
    pass.read(sums, read);
    values = pass.write(values, Use::ComputeWrite);
    return dispatches.next(pass, pass.kernel(scanned ? pipelines_.applyScanned : pipelines_.apply, {values, sums}), tiles,
                           ScanPush{count_});
  });
  return values;
}

}  // namespace rill
