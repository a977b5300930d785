#version 460
// Shades the pixels of particles. A workgroup is a listed tile.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"
#include "views/particle_tiles.glsl"
#include "views/particle_lighting.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 3) readonly buffer Winner { uint winner[]; };
layout(std430, set = 0, binding = 4) readonly buffer Position { vec4 position[]; };
layout(std430, set = 0, binding = 5) readonly buffer Tint { uvec2 tint[]; };
layout(std430, set = 0, binding = 6) writeonly buffer Shaded { uint shaded[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Rims { uint rims[]; };

void main() {
  const uint group = groupIndex();
  if (group >= counters[kTileCount + kTilesFluid]) return;
  const uvec2 pixel = shadeTileOrigin(tiles[kTilesFluid * shadeTiles() + group]) + gl_LocalInvocationID.xy;
  if (pixel.x >= view.width || pixel.y >= view.height) return;
  const uint index = pixel.y * view.width + pixel.x;
  const uint id = winner[index];
  if (id >= kSolidBase) return;

  const vec2 tangent = tangentOf(vec2(pixel) + 0.5);
  const vec3 center = viewPoint(particlePoint(position[id].xyz));
  const float radius = drawnRadius(center.z);
  const float t = sphereDepth(center, radius, tangent);
  const vec3 local = (vec3(tangent, 1.0) * t - center) / radius;
  const vec3 normal = normalize(rightAxis() * local.x + upAxis() * local.y + forwardAxis() * local.z);
  const uvec2 packed = tint[id];
  const vec3 root = vec3(unpackUnorm2x16(packed.x), float(packed.y & 0xFFFFu) / 65535.0);
  const float open = float((packed.y >> 16) & 0xFFu) / 255.0, light = float(packed.y >> 24) / 255.0;
  const vec3 to_light = scene.light_to.xyz;
  const float diffuse = max(0.85 * dot(normal, to_light) + 0.15, 0.0);
  const vec3 half_way = normalize(to_light - normalize(rayOf(tangent)));
  float glint = max(dot(normal, half_way), 0.0);  // to the 32nd power
  glint *= glint;
  glint *= glint;
  glint *= glint;
  glint *= glint;
  glint *= glint;
  const vec3 lit = ambient(normal) * mix(0.35, 1.0, open) + kKey * (diffuse * mix(0.25, 1.0, light) * mix(0.7, 1.0, open));
  shaded[index] = packColor(view.unlit != 0u ? root * root : root * root * lit + kKey * (0.10 * glint * light));
  rims[index] = sphereRim(center, radius, tangent);
}
