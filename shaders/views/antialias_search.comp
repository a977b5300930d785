#version 460
// Lists the pixels at edges, which are few, for antialias.comp.
#extension GL_GOOGLE_include_directive : require
#include "views/antialias.glsl"

layout(local_size_x = kPictureTile, local_size_y = kPictureTile) in;
layout(std430, set = 0, binding = 1) buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Edges { uint edges[]; };

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (p.x >= int(push.width) || p.y >= int(push.height)) return;
  const float c = lumaAt(p);
  const float n = lumaAt(p + ivec2(0, -1)), s = lumaAt(p + ivec2(0, 1)), w = lumaAt(p + ivec2(-1, 0)), e = lumaAt(p + ivec2(1, 0));
  const float highest = max(c, max(max(n, s), max(w, e))), range = highest - min(c, min(min(n, s), min(w, e)));
  if (range < max(kMinContrast, kMinRelativeContrast * highest)) return;
  const uint k = atomicAdd(counts[kEdgePixels], 1u);
  edges[k] = uint(p.y) * push.width + uint(p.x);
  if (k % kEdgesAColumn == 0u) atomicMax(counts[0], k / kEdgesAColumn + 1u);
}
