#version 460
// Shades pixels without owner: the background, seen through the tank's walls. A workgroup is a listed tile. Final except near outlines.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"
#include "views/particle_tiles.glsl"
#include "views/particle_lighting.glsl"
#include "views/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 3) readonly buffer Winner { uint winner[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Shaded { uint shaded[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Rims { uint rims[]; };
layout(std430, set = 0, binding = 6) writeonly buffer Picture { uint picture[]; };

const vec3 kWall = vec3(0.30, 0.42, 0.52);

vec3 background(float y) { return mix(vec3(0.78, 0.80, 0.82), vec3(0.50, 0.52, 0.55), smoothstep(0.0, 1.0, y / float(view.height))); }

// The closed wall through which the ray leaves the domain tints the background.
vec3 overWalls(vec3 color, vec3 ray) {
  const vec3 eye = eyePoint();
  const vec3 step = vec3(ray.x < 0.0 ? -1.0 : 1.0, ray.y < 0.0 ? -1.0 : 1.0, ray.z < 0.0 ? -1.0 : 1.0) * max(abs(ray), vec3(1e-12));
  const vec3 a = (scene.domain_min.xyz - eye) / step, b = (scene.domain_max.xyz - eye) / step;
  const vec3 enter = min(a, b), leave = max(a, b);
  const float in_at = max(max(enter.x, enter.y), max(enter.z, 0.0)), out_at = min(leave.x, min(leave.y, leave.z));
  const uint side = out_at == leave.x ? (ray.x < 0.0 ? 0u : 1u) : (out_at == leave.y ? (ray.y < 0.0 ? 2u : 3u) : (ray.z < 0.0 ? 4u : 5u));
  const bool tinted = scene.domain_min.w > 0.0 && out_at > in_at && side != 2u && (scene.counts.w & (1u << side)) != 0u;
  const float height = clamp((eye.y + out_at * ray.y - scene.domain_min.y) / (scene.domain_max.y - scene.domain_min.y), 0.0, 1.0);
  return tinted ? mix(color, kWall, mix(0.26, 0.10, height)) : color;
}

void main() {
  const uint group = groupIndex();
  if (group >= counters[kTileCount + kTilesSky]) return;
  const uvec2 pixel = shadeTileOrigin(tiles[kTilesSky * shadeTiles() + group]) + gl_LocalInvocationID.xy;
  if (pixel.x >= view.width || pixel.y >= view.height) return;
  const uint index = pixel.y * view.width + pixel.x;
  if (winner[index] != kNobody) return;
  const vec2 middle = vec2(pixel) + 0.5;
  const vec3 ray = rayOf(tangentOf(middle));
  const uint packed = packColor(view.unlit != 0u ? kPlain : overWalls(background(middle.y), ray));
  shaded[index] = packed;
  rims[index] = kNoRim;
  picture[index] = encodeSrgb(unpackColor(packed));  // as view resolve unpacks it: the same bits in tiles with and without outlines
}
