#version 460
// The nearest floor or solid of every pixel; with LIGHT, the nearest solid of every texel of the light map.
// A workgroup is a tile: it looks at all solids together and each pixel only at those whose bounding sphere meets the tile.
#extension GL_GOOGLE_include_directive : require
#include "render/particle_view.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Poses { PoseRecord poses[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Depth { uint depth[]; };
#ifndef LIGHT
layout(std430, set = 0, binding = 3) writeonly buffer Winner { uint winner[]; };
#endif
#include "render/particle_light.glsl"
#include "render/particle_solids.glsl"

shared uint near_solids[256];
shared uint near_count;

bool meetsTile(PoseRecord pose, uvec2 tile) {
  const vec2 low = vec2(tile * kPixelTile), high = low + float(kPixelTile);
#ifdef LIGHT
  const vec2 at = lightTexel(pose.centre.xyz);
  const float reach = pose.view.w / scene.light_texel.x + 1.0;
  return all(greaterThan(at + reach, low)) && all(lessThan(at - reach, high));
#else
  const vec3 c = pose.view.xyz;
  const float r = pose.view.w;
  const vec2 a = tangentOf(low), b = tangentOf(high);  // left and top, right and bottom
  return c.z + r > view.near_depth && c.x - a.x * c.z > -r * sqrt(1.0 + a.x * a.x) && c.x - b.x * c.z < r * sqrt(1.0 + b.x * b.x) &&
         c.y - a.y * c.z < r * sqrt(1.0 + a.y * a.y) && c.y - b.y * c.z > -r * sqrt(1.0 + b.y * b.y);
#endif
}

void main() {
#ifdef LIGHT
  const uvec2 size = scene.counts.yz;
#else
  const uvec2 size = uvec2(view.width, view.height);
#endif
  const uint columns = (size.x + kPixelTile - 1u) / kPixelTile, rows = (size.y + kPixelTile - 1u) / kPixelTile;
  const uint group = groupIndex();
  if (group >= columns * rows) return;
  const uvec2 tile = uvec2(group % columns, group / columns);
  const uvec2 pixel = tile * kPixelTile + gl_LocalInvocationID.xy;

  float best = uintBitsToFloat(0x7F800000u);
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
  for (uint base = 0u; base < scene.counts.x; base += 256u) {
    barrier();
    if (gl_LocalInvocationIndex == 0u) near_count = 0u;
    barrier();
    const uint mine = base + gl_LocalInvocationIndex;
    if (mine < scene.counts.x && meetsTile(poses[mine], tile)) near_solids[atomicAdd(near_count, 1u)] = mine;
    barrier();
    for (uint k = 0u; k < near_count; ++k) {
      const uint solid = near_solids[k];
      vec3 normal;
      const float t = solidHit(poses[solid], from, ray, normal);
      if (t >= nearest && (t < best || (t == best && kSolidBase + solid < owner))) {
        best = t;
        owner = kSolidBase + solid;
      }
    }
  }
  if (pixel.x >= size.x || pixel.y >= size.y) return;
  const uint index = pixel.y * size.x + pixel.x;
  depth[index] = floatBitsToUint(best);
#ifndef LIGHT
  winner[index] = owner;
#endif
}
