#version 460
// Antialiases outlines: an outline that crosses a pixel gives the owner's coverage; the rest has the color of the neighbor beyond it.
// A workgroup is a listed tile.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"
#include "views/particle_tiles.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 1) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 2) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 3) readonly buffer Shaded { uint shaded[]; };
layout(std430, set = 0, binding = 4) readonly buffer Rims { uint rims[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Picture { uint picture[]; };
#include "views/srgb.glsl"

uint indexAt(ivec2 pixel) {
  const ivec2 at = clamp(pixel, ivec2(0), ivec2(view.width, view.height) - 1);
  return uint(at.y) * view.width + uint(at.x);
}

void main() {
  const uint group = groupIndex();
  if (group >= counters[kTileCount + kTilesOutline]) return;
  const uint tile = tiles[kTilesOutline * shadeTiles() + group];
  const ivec2 pixel = ivec2(shadeTileOrigin(tile) + gl_LocalInvocationID.xy);
  if (pixel.x >= int(view.width) || pixel.y >= int(view.height)) return;
  const uint index = indexAt(pixel);
  const uint bits = depth[index];

  vec3 color = unpackColor(shaded[index]);
  const uint rim = rims[index];
  if (rimDistance(rim) < 0.5) color = mix(unpackColor(shaded[indexAt(pixel + rimStep(rim))]), color, 0.5 + rimDistance(rim));
  RILL_LOOP for (uint side = 0u; side < 4u; ++side) {
    const uint other = indexAt(pixel - rimStep(side));  // its outline may cross this pixel
    const uint reaching = rims[other];
    const float reach = rimDistance(reaching) - 0.5;
    if ((reaching & 3u) == side && reach > 0.0 && reach < 0.5 && depth[other] < bits) color = mix(color, unpackColor(shaded[other]), reach);
  }
  picture[index] = encodeSrgb(color);
}
