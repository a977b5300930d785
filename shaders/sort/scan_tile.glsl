// Scans one tile of `values` (uvec4) in place, starting from `offset`, and returns the tile's sum. Each
// invocation handles kScanItems consecutive values.
#include "sort/workgroup_scan.glsl"

uint scanTile(uint first, uint offset) {
  const uint begin = (first + scanLane() * kScanItems) / 4u, end = (push.count + 3u) / 4u;
  uvec4 items[kScanItems / 4u];
  uint sum = 0u;
  for (uint j = 0u; j < kScanItems / 4u; ++j) {
    items[j] = begin + j < end ? values[begin + j] : uvec4(0u);
    sum += items[j].x + items[j].y + items[j].z + items[j].w;
  }
  uint total;
  uint running = offset + workgroupExclusiveAdd(sum, total);
  for (uint j = 0u; j < kScanItems / 4u; ++j) {
    const uvec4 item = items[j];
    uvec4 before = uvec4(running);
    before.yzw += item.x;
    before.zw += item.y;
    before.w += item.z;
    running = before.w + item.w;
    if (begin + j < end) values[begin + j] = before;
  }
  return total;
}
