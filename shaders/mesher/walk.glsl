// The particles near a point or a bin. The including shader makes neighborsAt() and startAt() before, and then visit(slot).
#include "shared/loops.glsl"
void visit(uint slot);

// Particles in bins within `reach` of the points of a bin, which lie up to `span` from its lower corner along each axis. False if
// kMeshMaxVisits has cut the walk off.
bool walk(uint block, ivec3 bin, float span, float reach) {
  const float side = binSide();
  const int most = int(ceil(reach / side));
  uint left = kMeshMaxVisits;
  for (int x = -most; x <= most; ++x) {
    const float dx = max(x < 0 ? float(-x - 1) * side : float(x) * side - span, 0.0);
    for (int y = -most; y <= most; ++y) {
      const float dy = max(y < 0 ? float(-y - 1) * side : float(y) * side - span, 0.0);
      const float free = reach * reach - dx * dx - dy * dy;
      if (free <= 0.0) continue;
      const float dz = sqrt(free);
      const ivec3 row = bin + ivec3(x, y, 0);
      const int first = bin.z - int(ceil(dz / side)), last = bin.z + int(floor((dz + span) / side));
      for (int b = first >> 2; b <= last >> 2; ++b) {
        const uint other = neighborsAt(neighborSlot(block, ivec3(row.x >> 2, row.y >> 2, b)));
        if (other == kMeshNone) continue;
        const uint base = other * kMeshBlockBins + binIn(uvec3(row.x & 3, row.y & 3, 0));
        const uint from = startAt(base + uint(max(first - 4 * b, 0))), to = startAt(base + uint(min(last - 4 * b, 3)) + 1u);
        const uint end = from + min(to - from, left);
        uint slot = from;
        LOOP_WHILE (slot < end) {
          visit(slot);
          ++slot;
        } LOOP_END(slot < end);
        left -= end - from;
        if (left == 0u) return false;
      }
    }
  }
  return true;
}
