#version 460
// Shades the floor and the background, a workgroup a tile of the list. Where no outline is near, that is the picture.
#extension GL_GOOGLE_include_directive : require
#include "render/particle_view.glsl"
#include "render/particle_tiles.glsl"
#include "render/particle_lighting.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 3) readonly buffer Winner { uint winner[]; };
layout(std430, set = 0, binding = 4) readonly buffer FloorLight { float floor_light[]; };
layout(std430, set = 0, binding = 5) readonly buffer TileEdges { uint tile_edges[]; };
layout(std430, set = 0, binding = 6) readonly buffer Edges { EdgeRecord edges[]; };
layout(std430, set = 0, binding = 7) readonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 8) writeonly buffer Shaded { uint shaded[]; };
layout(std430, set = 0, binding = 9) writeonly buffer Rims { uint rims[]; };
layout(std430, set = 0, binding = 10) writeonly buffer Picture { uint picture[]; };
#include "render/particle_light.glsl"
#include "render/particle_finish.glsl"

const vec3 kWall = vec3(0.30, 0.42, 0.52);
const vec3 kFloor = vec3(0.50, 0.50, 0.49);

vec3 background(float y) { return mix(vec3(0.78, 0.80, 0.82), vec3(0.50, 0.52, 0.55), smoothstep(0.0, 1.0, y / float(view.height))); }

// How much of a pixel `width` wide the grid lines cover at `at`, lines being `line` wide and `step` apart.
float gridCover(float at, float width, float line, float step) {
  const float drawn = max(line, width);
  const float distance = abs(fract(at / step - 0.5) - 0.5) * step;
  const float cover = clamp((0.5 * drawn - distance) / width + 0.5, 0.0, 1.0) * (line / drawn);
  return mix(cover, line / step, clamp(2.0 * width / step - 0.5, 0.0, 1.0));
}

float floorLight(vec3 at) {
  if (view.count + scene.counts.x == 0u) return 1.0;  // nothing casts a shadow, and there is no map
  const vec2 limit = vec2(scene.counts.yz) - 1.001;
  const vec2 texel = clamp(lightTexel(at), vec2(0.0), limit);  // the map's border sees past everything
  const uvec2 base = uvec2(texel);
  const vec2 part = texel - vec2(base);
  const uint row = base.y * scene.counts.y + base.x;
  return mix(mix(floor_light[row], floor_light[row + 1u], part.x),
             mix(floor_light[row + scene.counts.y], floor_light[row + scene.counts.y + 1u], part.x), part.y);
}

vec3 shadeFloor(vec3 ray) {
  const vec3 eye = eyePoint();
  const float t = (scene.domain_min.y - eye.y) / ray.y;
  const vec2 at = eye.xz + t * ray.xz;
  // How far the hit moves from a pixel to the next.
  const vec2 right = (rightAxis().xz - ray.xz * (rightAxis().y / ray.y)) * (t / view.focal);
  const vec2 up = (upAxis().xz - ray.xz * (upAxis().y / ray.y)) * (t / view.focal);
  const vec2 width = abs(right) + abs(up);
  const float step = scene.domain_max.w, line = 0.02 * step;
  const vec2 inner = at - scene.domain_min.xz;
  const float grid = max(gridCover(inner.x, width.x, line, step), gridCover(inner.y, width.y, line, step));
  const vec2 extent = scene.domain_max.xz - scene.domain_min.xz;
  const vec2 rim = min(inner, extent - inner) / (0.06 * max(min(extent.x, extent.y), step));
  const float corner = (1.0 - 0.12 * exp(-max(rim.x, 0.0))) * (1.0 - 0.12 * exp(-max(rim.y, 0.0)));
  const float light = floorLight(vec3(at.x, scene.domain_min.y, at.y));
  const vec3 colour = kFloor * mix(1.0, 0.72, grid);
  return colour * corner * (kSky * mix(0.55, 1.0, light) + kKey * (max(scene.light_to.y, 0.0) * light));
}

// The closed wall through which the ray leaves the domain tints what is behind it.
vec3 overWalls(vec3 colour, vec3 ray) {
  const vec3 eye = eyePoint();
  const vec3 step = vec3(ray.x < 0.0 ? -1.0 : 1.0, ray.y < 0.0 ? -1.0 : 1.0, ray.z < 0.0 ? -1.0 : 1.0) * max(abs(ray), vec3(1e-12));
  const vec3 a = (scene.domain_min.xyz - eye) / step, b = (scene.domain_max.xyz - eye) / step;
  const vec3 enter = min(a, b), leave = max(a, b);
  const float in_at = max(max(enter.x, enter.y), max(enter.z, 0.0)), out_at = min(leave.x, min(leave.y, leave.z));
  const uint side = out_at == leave.x ? (ray.x < 0.0 ? 0u : 1u) : (out_at == leave.y ? (ray.y < 0.0 ? 2u : 3u) : (ray.z < 0.0 ? 4u : 5u));
  const bool tinted = scene.domain_min.w > 0.0 && out_at > in_at && side != 2u && (scene.counts.w & (1u << side)) != 0u;
  const float height = clamp((eye.y + out_at * ray.y - scene.domain_min.y) / (scene.domain_max.y - scene.domain_min.y), 0.0, 1.0);
  return tinted ? mix(colour, kWall, mix(0.26, 0.10, height)) : colour;
}

void main() {
  const uint group = groupIndex();
  if (group >= counters[kTileCount + kTilesBackdrop]) return;
  const uint tile = tiles[kTilesBackdrop * shadeTiles() + group];
  const uvec2 pixel = shadeTileOrigin(tile) + gl_LocalInvocationID.xy;
  if (pixel.x >= view.width || pixel.y >= view.height) return;
  const uint index = pixel.y * view.width + pixel.x;
  const uint id = winner[index];
  if (id < kFloorId) return;
  const vec2 middle = vec2(pixel) + 0.5;
  const vec3 ray = rayOf(tangentOf(middle));
  const vec3 colour = id == kFloorId ? shadeFloor(ray) : overWalls(background(middle.y), ray);
  shaded[index] = packColour(colour);
  rims[index] = kNoRim;
  picture[index] = encoded(overEdges(colour, tile_edges[tile], middle, uintBitsToFloat(depth[index])));
}
