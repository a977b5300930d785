#version 460
// Dispatch arguments from the counts of survivors and tiles. Runs after each count and writes all arguments.
#extension GL_GOOGLE_include_directive : require
#include "shared/dispatch.glsl"
#include "views/particle_view.glsl"

layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) buffer Counters { uint counters[]; };

void writeArguments(uint at, uint groups) {
  const uvec3 folded = foldGroups(groups);
  counters[at] = folded.x;
  counters[at + 1u] = folded.y;
  counters[at + 2u] = folded.z;
}

void main() {
  RILL_LOOP for (uint list = 0u; list < kTileLists; ++list) writeArguments(kTileArguments + 4u * list, counters[kTileCount + list]);
  const uint small = counters[kSmallCount], large = counters[kLargeCount];
  const uint tiles = ((view.width + kPixelTile - 1u) / kPixelTile) * ((view.height + kPixelTile - 1u) / kPixelTile);
  writeArguments(kSmallArguments, (small + kParticleGroup - 1u) / kParticleGroup);
  writeArguments(kLargeArguments, tiles * ((large + kLargeChunk - 1u) / kLargeChunk));
  writeArguments(kTintArguments, (small + large + kParticleGroup - 1u) / kParticleGroup);
}
