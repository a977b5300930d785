// The particles that may reach points of a bin: those of its list (lists.comp), or of a walk where it has none. The including shader
// makes bin_listsAt(), listsAt(), `counts` and what walk.glsl needs before, and visit(slot) after.
#include "mesher/walk.glsl"

// False if kMeshMaxVisits has cut a walk off.
bool visitNear(uint block, uvec3 bin) {
  const uvec2 list = bin_listsAt(block * kMeshBlockBins + binIn(bin));
  const bool listed = list.y != kMeshNone && counts[kMeshListed] <= mesh.max_listed && counts[kMeshNearBins] <= kMeshMaxNearBins;
  uint k = list.x;
  const uint end = listed ? list.x + list.y : list.x;
  LOOP_WHILE (k < end) {
    visit(listsAt(k));
    ++k;
  } LOOP_END(k < end);
  return listed || walk(block, ivec3(bin), binSide(), kMeshReach);
}
