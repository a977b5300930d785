#version 460
// Draws the domain's edges over the picture, with a depth test. A workgroup is a listed tile.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"
#include "views/particle_tiles.glsl"
#include "views/particle_lighting.glsl"
#include "views/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 1) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 2) readonly buffer Edges { EdgeRecord edges[]; };
layout(std430, set = 0, binding = 3) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 4) buffer Picture { uint picture[]; };

const vec3 kLine = vec3(0.045, 0.055, 0.07);

void main() {
  const uint group = groupIndex();
  if (group >= counters[kTileCount + kTilesEdge]) return;
  const uvec2 at = shadeTileOrigin(tiles[kTilesEdge * shadeTiles() + group]) + gl_LocalInvocationID.xy;
  if (at.x >= view.width || at.y >= view.height) return;
  const uint index = at.y * view.width + at.x;
  const float own = uintBitsToFloat(depth[index]);
  const vec2 pixel = vec2(at) + 0.5;
  const float half_width = edgeHalfWidth();
  float cover = 0.0;
  RILL_LOOP for (uint k = 0u; k < kEdges; ++k) {
    const EdgeRecord edge = edges[k];
    const float distance = abs(dot(edge.line.xy, pixel) + edge.line.z);
    const float along = dot(edge.along.xy, pixel);
    const float ends = min(along - edge.along.z, edge.along.w - along) + 0.5;
    const float line_depth = 0.9995 / max(edge.depth.x + edge.depth.y * (along - edge.along.z), 1e-30);
    if (own > line_depth) cover = max(cover, clamp(half_width + 0.5 - distance, 0.0, 1.0) * clamp(ends, 0.0, 1.0) * edge.line.w);
  }
  if (cover == 0.0) return;
  const vec3 color = decodeSrgb(unpackUnorm4x8(picture[index]).rgb);
  picture[index] = encodeSrgb(mix(color, view.unlit != 0u ? kPlainSolid : kLine, 0.62 * cover));
}
