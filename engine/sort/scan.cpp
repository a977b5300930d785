#include "sort/scan.hpp"

#include <string>

#include "sort/pipelines.hpp"
#include "sort/sort_types.h"

namespace rill {
namespace {

/// Up to so many values one workgroup is done before two more dispatches have started.
constexpr uint32_t kSingleCount = 8 * kScanTile;

uint32_t tileCount(uint32_t count) { return (count + kScanTile - 1) / kScanTile; }

}  // namespace

Expected<Scan> Scan::create(Device& device, uint32_t count) {
  if (count > kMaxCount)
    return Error{ErrorKind::BadInput, "scan: " + std::to_string(count) + " values, at most " + std::to_string(kMaxCount) + " are possible"};
  Scan scan;
  scan.count_ = count;
  if (count == 0) return scan;
  StoragePipelines pipelines(device, sizeof(ScanPush));
  scan.single_ = pipelines.make("sort/scan_single", 1);
  if (count > kSingleCount) {
    scan.reduce_ = pipelines.make("sort/scan_reduce", 2);
    scan.apply_ = pipelines.make("sort/scan_apply", 2);
  }
  if (auto made = pipelines.result(); !made) return made.error();
  return scan;
}

std::vector<GroupCount> Scan::groups() const {
  if (count_ == 0) return {};
  if (!reduce_) return {foldGroups(1)};
  return {foldGroups(tileCount(count_)), foldGroups(1), foldGroups(tileCount(count_))};
}

BufferRef Scan::addTo(Graph& graph, BufferRef values, const Gate* gate) const {
  if (count_ == 0) return values;
  Dispatches dispatches(gate);
  const auto single = [&](std::string_view name, BufferRef& buffer, uint32_t count) {
    graph.pass(name, [&](Pass& pass) {
      buffer = pass.write(buffer, Use::ComputeWrite);
      return dispatches.next(pass, pass.kernel(single_, {buffer}), 1, ScanPush{count});
    });
  };
  if (!reduce_) {
    single("sort/scan", values, count_);
    return values;
  }
  const uint32_t tiles = tileCount(count_);
  BufferRef sums = graph.create("scan tile sums", {tiles * sizeof(uint32_t)});
  graph.pass("sort/scan reduce", [&](Pass& pass) {
    pass.read(values, Use::ComputeRead);
    sums = pass.write(sums, Use::ComputeWrite, true);
    return dispatches.next(pass, pass.kernel(reduce_, {values, sums}), tiles, ScanPush{count_});
  });
  single("sort/scan tiles", sums, tiles);
  graph.pass("sort/scan apply", [&](Pass& pass) {
    pass.read(sums, Use::ComputeRead);
    values = pass.write(values, Use::ComputeWrite);
    return dispatches.next(pass, pass.kernel(apply_, {values, sums}), tiles, ScanPush{count_});
  });
  return values;
}

}  // namespace rill
