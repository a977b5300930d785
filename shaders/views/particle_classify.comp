#version 460
// Lists the shading tiles by what they hold, one invocation per tile. Each list is shaded by a shader for one kind of owner, because
// software drivers execute both sides of branches.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"
#include "views/particle_tiles.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Winner { uint winner[]; };
layout(std430, set = 0, binding = 1) readonly buffer Edges { EdgeRecord edges[]; };
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Tiles { uint tiles[]; };  // kTileLists lists, each with room for all tiles

void main() {
  const uint index = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  const uint count = shadeTiles();
  if (index >= count) return;
  const ivec2 first = ivec2(shadeTileOrigin(index)), last = first + int(kShadeTile) - 1;
  const ivec2 limit = ivec2(view.width, view.height) - 1;
  uint kinds = 0u, around = 0u;
  for (int y = max(first.y - 1, 0); y <= min(last.y + 1, limit.y); ++y) {
    for (int x = max(first.x - 1, 0); x <= min(last.x + 1, limit.x); ++x) {
      const uint owner = winner[uint(y) * view.width + uint(x)];
      const uint kind = 1u << (owner < kSolidBase ? kTilesFluid
                                                  : (owner == kNobody ? kTilesSky : (owner == kFloorId ? kTilesFloor : kTilesSolid)));
      around |= kind;
      if (x >= first.x && x <= last.x && y >= first.y && y <= last.y) kinds |= kind;
    }
  }
  if ((around & (1u << kTilesFluid | 1u << kTilesSolid)) != 0u) kinds |= 1u << kTilesOutline;
  const vec2 middle = vec2(first) + 0.5 * float(kShadeTile);
  const float reach = 0.7072 * float(kShadeTile) + edgeHalfWidth() + 0.5;
  RILL_LOOP for (uint k = 0u; k < kEdges; ++k) {
    const EdgeRecord edge = edges[k];
    const float along = dot(edge.along.xy, middle);
    if (edge.line.w > 0.0 && abs(dot(edge.line.xy, middle) + edge.line.z) < reach &&
        along > edge.along.z - reach && along < edge.along.w + reach) {
      kinds |= 1u << kTilesEdge;
    }
  }
  RILL_LOOP for (uint list = 0u; list < kTileLists; ++list) {
    if ((kinds & (1u << list)) != 0u) tiles[list * count + atomicAdd(counters[kTileCount + list], 1u)] = index;
  }
}
