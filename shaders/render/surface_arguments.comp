#version 460
// Dispatch and draw arguments from the counts so far.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "shared/dispatch.glsl"

layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Arguments { uint arguments[]; };

void groups(uint at, uint count) {
  const uvec3 folded = foldGroups(count);
  arguments[at] = folded.x;
  arguments[at + 1u] = folded.y;
  arguments[at + 2u] = folded.z;
}

void main() {
  groups(kSurvivorArguments, (counters[kSurvivorCount] + kSurfaceGroup - 1u) / kSurfaceGroup);
  groups(kSurfaceArguments, (counters[kSurfaceCount] + kSurfaceGroup - 1u) / kSurfaceGroup);
  groups(kSurfaceTileArguments, counters[kSurfaceTileCount]);
  groups(kEdgeArguments, (counters[kEdgeCount] + kSurfaceGroup - 1u) / kSurfaceGroup);
  groups(kSampleBlockArguments, counters[kSampleBlockCount]);
  groups(kPixelArguments, counters[kSurvivorCount] == 0u ? 0u : (view.width * view.height + kSurfaceGroup - 1u) / kSurfaceGroup);
  arguments[kTileDraw] = 6u;
  arguments[kTileDraw + 1u] = counters[kSurfaceTileCount];
  arguments[kTileDraw + 2u] = arguments[kTileDraw + 3u] = 0u;
}
