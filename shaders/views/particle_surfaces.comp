#version 460
// The nearest floor or solid of every pixel; with LIGHT, the nearest solid of every texel of the
// light map; with BARE, for scenes without solids.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
#ifdef LIGHT
layout(std430, set = 0, binding = 1) writeonly buffer LightMap { uint light_map[]; };
#define FIRST_SOLID_BINDING 2
#else
layout(std430, set = 0, binding = 1) writeonly buffer Depth { uint depth[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Winner { uint winner[]; };
#define FIRST_SOLID_BINDING 3
#endif
#include "views/particle_light.glsl"
#include "views/particle_frustum.glsl"
#ifndef BARE
layout(std430, set = 0, binding = FIRST_SOLID_BINDING) readonly buffer Placed { PlacedSolid placed[]; };
layout(std430, set = 0, binding = FIRST_SOLID_BINDING + 1) readonly buffer Masks { uint masks[]; };
#include "views/particle_solids.glsl"
#endif

void main() {
  const uvec2 size = surfaceSize();
  const uint tile = groupIndex();
  if (tile >= surfaceTiles()) return;
  const uvec2 pixel = uvec2(tile % surfaceColumns(), tile / surfaceColumns()) * kPixelTile + gl_LocalInvocationID.xy;
  if (pixel.x >= size.x || pixel.y >= size.y) return;

  float best = noDepth();
  uint owner = kNobody;
#ifdef LIGHT
  // From the plane that light depth counts from, along the light.
  const vec3 from = scene.light_u.xyz * (scene.light_u.w + float(pixel.x) * scene.light_texel.x) +
                    scene.light_v.xyz * (scene.light_v.w + float(pixel.y) * scene.light_texel.x) + scene.light_to.xyz * scene.light_to.w;
  const vec3 ray = -scene.light_to.xyz;
  const float nearest = 0.0;
#else
  const vec3 from = eyePoint();
  const vec3 ray = rayOf(tangentOf(vec2(pixel) + 0.5));
  const float nearest = view.near_depth;
  if (scene.domain_min.w > 0.0 && (scene.counts.w & 4u) != 0u && ray.y < 0.0) {
    const float t = (scene.domain_min.y - from.y) / ray.y;
    const vec2 at = from.xz + t * ray.xz;
    if (t > nearest && all(greaterThanEqual(at, scene.domain_min.xz)) && all(lessThanEqual(at, scene.domain_max.xz))) {
      best = t;
      owner = kFloorId;
    }
  }
#endif
#ifndef BARE
  const uint words = solidWords();
  for (uint word = 0u; word < words; ++word) {
    for (uint mask = masks[tile * words + word]; mask != 0u; mask &= mask - 1u) {
      const uint solid = word * 32u + uint(findLSB(mask));
      vec3 normal;
      const float t = solidHit(placed[solid], from, ray, normal);
      if (t >= nearest && t < best) {
        best = t;
        owner = kSolidBase + solid;
      }
    }
  }
#endif
  const uint index = pixel.y * size.x + pixel.x;
#ifdef LIGHT
  light_map[index] = floatBitsToUint(best);
#else
  depth[index] = floatBitsToUint(best);
  winner[index] = owner;
#endif
}
