#version 460
// Shades the floor: grid lines and, with SHADOWS, soft shadows. A workgroup is a listed tile. Final except near outlines.
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
#ifdef SHADOWS
layout(std430, set = 0, binding = 7) readonly buffer FloorLight { float floor_light[]; };
#endif
#include "views/particle_light.glsl"

const vec3 kFloor = vec3(0.50, 0.50, 0.49);

// Coverage of a pixel of size `width` at `at` by grid lines of width `line`, `step` apart.
float gridCover(float at, float width, float line, float step) {
  const float drawn = max(line, width);
  const float distance = abs(fract(at / step - 0.5) - 0.5) * step;
  const float cover = clamp((0.5 * drawn - distance) / width + 0.5, 0.0, 1.0) * (line / drawn);
  return mix(cover, line / step, clamp(2.0 * width / step - 0.5, 0.0, 1.0));
}

float floorLight(vec3 at) {
#ifdef SHADOWS
  const vec2 limit = vec2(scene.counts.yz) - 1.001;
  const vec2 texel = clamp(lightTexel(at), vec2(0.0), limit);  // the map's border is lit
  const uvec2 base = uvec2(texel);
  const vec2 part = texel - vec2(base);
  const uint row = base.y * scene.counts.y + base.x;
  return mix(mix(floor_light[row], floor_light[row + 1u], part.x),
             mix(floor_light[row + scene.counts.y], floor_light[row + scene.counts.y + 1u], part.x), part.y);
#else
  return 1.0;
#endif
}

vec3 shadeFloor(vec3 ray) {
  const vec3 eye = eyePoint();
  const float t = (scene.domain_min.y - eye.y) / ray.y;
  const vec2 at = eye.xz + t * ray.xz;
  // Screen-space derivatives of the hit.
  const vec2 right = (rightAxis().xz - ray.xz * (rightAxis().y / ray.y)) * (t / view.focal);
  const vec2 up = (upAxis().xz - ray.xz * (upAxis().y / ray.y)) * (t / view.focal);
  const vec2 width = abs(right) + abs(up);
  const float step = scene.domain_max.w, line = 0.02 * step;
  const vec2 inner = at - scene.domain_min.xz;
  const float grid = max(gridCover(inner.x, width.x, line, step), gridCover(inner.y, width.y, line, step));
  if (view.unlit != 0u) return mix(kPlain, kPlainGrid, grid);
  const vec2 extent = scene.domain_max.xz - scene.domain_min.xz;
  const vec2 rim = min(inner, extent - inner) / (0.06 * max(min(extent.x, extent.y), step));
  const float corner = (1.0 - 0.12 * exp(-max(rim.x, 0.0))) * (1.0 - 0.12 * exp(-max(rim.y, 0.0)));
  const float light = floorLight(vec3(at.x, scene.domain_min.y, at.y));
  const vec3 color = kFloor * mix(1.0, 0.72, grid);
  return color * corner * (kSky * mix(0.55, 1.0, light) + kKey * (max(scene.light_to.y, 0.0) * light));
}

void main() {
  const uint group = groupIndex();
  if (group >= counters[kTileCount + kTilesFloor]) return;
  const uvec2 pixel = shadeTileOrigin(tiles[kTilesFloor * shadeTiles() + group]) + gl_LocalInvocationID.xy;
  if (pixel.x >= view.width || pixel.y >= view.height) return;
  const uint index = pixel.y * view.width + pixel.x;
  if (winner[index] != kFloorId) return;
  const vec2 middle = vec2(pixel) + 0.5;
  const vec3 ray = rayOf(tangentOf(middle));
  const uint packed = packColor(shadeFloor(ray));
  shaded[index] = packed;
  rims[index] = kNoRim;
  picture[index] = encodeSrgb(unpackColor(packed));  // as view resolve unpacks it: the same bits in tiles with and without outlines
}
