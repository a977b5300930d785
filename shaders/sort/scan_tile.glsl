// Scans one tile of `values` in place, from `offset`, and returns the tile's sum. Each invocation takes kScanItems consecutive values.
#include "sort/workgroup_scan.glsl"

uint scanTile(uint first, uint offset) {
  const uint begin = first + scanLane() * kScanItems;
  uint item[kScanItems];
  uint sum = 0u;
  for (uint j = 0u; j < kScanItems; ++j) {
    item[j] = begin + j < push.count ? values[begin + j] : 0u;
    sum += item[j];
  }
  uint total;
  uint running = offset + workgroupExclusiveAdd(sum, total);
  for (uint j = 0u; j < kScanItems; ++j) {
    if (begin + j < push.count) values[begin + j] = running;
    running += item[j];
  }
  return total;
}
