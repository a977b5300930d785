#version 460
// Lists the shading tiles by what they hold, and notes which of the domain's edges cross each. An invocation is a tile.
// Kernels for one kind of owner each, on lists of tiles: a software driver runs both sides of every branch.
#extension GL_GOOGLE_include_directive : require
#include "render/particle_view.glsl"
#include "render/particle_tiles.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Winner { uint winner[]; };
layout(std430, set = 0, binding = 1) readonly buffer Edges { EdgeRecord edges[]; };
layout(std430, set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Tiles { uint tiles[]; };          // list after list, each as long as there are tiles
layout(std430, set = 0, binding = 4) writeonly buffer TileEdges { uint tile_edges[]; };  // a bit an edge

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
      const uint kind = 1u << (owner < kSolidBase ? kTilesFluid : (owner >= kFloorId ? kTilesBackdrop : kTilesSolid));
      around |= kind;
      if (x >= first.x && x <= last.x && y >= first.y && y <= last.y) kinds |= kind;
    }
  }
  if ((around & ~(1u << kTilesBackdrop)) != 0u) kinds |= 1u << kTilesOutline;
  for (uint list = 0u; list < kTileLists; ++list) {
    if ((kinds & (1u << list)) != 0u) tiles[list * count + atomicAdd(counters[kTileCount + list], 1u)] = index;
  }
  const vec2 middle = vec2(first) + 0.5 * float(kShadeTile);
  const float reach = 0.7072 * float(kShadeTile) + edgeHalfWidth() + 0.5;
  uint crossing = 0u;
  RILL_LOOP for (uint k = 0u; k < kEdges; ++k) {
    const EdgeRecord edge = edges[k];
    const float along = dot(edge.along.xy, middle);
    if (edge.line.w > 0.0 && abs(dot(edge.line.xy, middle) + edge.line.z) < reach && along > edge.along.z - reach && along < edge.along.w + reach) {
      crossing |= 1u << k;
    }
  }
  tile_edges[index] = crossing;
}
