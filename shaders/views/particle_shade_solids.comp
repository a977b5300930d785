#version 460
// Shades the pixels that solids own, a workgroup a tile of the list.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"
#include "views/particle_tiles.glsl"
#include "views/particle_lighting.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(std430, set = 0, binding = 2) readonly buffer Tiles { uint tiles[]; };
layout(std430, set = 0, binding = 3) readonly buffer Winner { uint winner[]; };
layout(std430, set = 0, binding = 4) readonly buffer Placed { PlacedSolid placed[]; };
layout(std430, set = 0, binding = 5) readonly buffer LightMap { uint light_map[]; };
layout(std430, set = 0, binding = 6) writeonly buffer Shaded { uint shaded[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Rims { uint rims[]; };
#define LIGHT_MAP_READ
#include "views/particle_light.glsl"
#include "views/particle_solids.glsl"

const vec3 kSolid = vec3(0.62, 0.50, 0.36);      // sand, against the blues of speed
const vec3 kSolidGray = vec3(0.36, 0.40, 0.44);  // against the warm colors of compression, and those of fluids

// Whether a box or a mesh is seen through a point of the image; spheres have a rim of their own.
bool sees(PlacedSolid solid, vec2 pixel) {
  vec3 normal;
  return solidHit(solid, eyePoint(), rayOf(tangentOf(pixel)), normal) >= view.near_depth;
}

// The rim of a box or a mesh: the nearest of four neighboring points that miss it, and by bisection where.
uint rimByRays(PlacedSolid solid, vec2 pixel) {
  uint best = kNoRim;
  RILL_LOOP for (uint side = 0u; side < 4u; ++side) {
    const vec2 step = vec2(rimStep(side));
    float low = 0.0, high = 1.0;
    if (sees(solid, pixel + step)) low = 1.0;
    RILL_LOOP for (int k = 0; k < 6; ++k) {
      const float middle = 0.5 * (low + high);
      if (sees(solid, pixel + middle * step)) low = middle; else high = middle;
    }
    if (low < 1.0 && low < rimDistance(best)) best = packRim(side, low);
  }
  return best;
}

void main() {
  const uint group = groupIndex();
  if (group >= counters[kTileCount + kTilesSolid]) return;
  const uvec2 pixel = shadeTileOrigin(tiles[kTilesSolid * shadeTiles() + group]) + gl_LocalInvocationID.xy;
  if (pixel.x >= view.width || pixel.y >= view.height) return;
  const uint index = pixel.y * view.width + pixel.x;
  const uint id = winner[index];
  if (id < kSolidBase || id >= kFloorId) return;

  const PlacedSolid solid = placed[id - kSolidBase];
  const vec2 middle = vec2(pixel) + 0.5;
  const vec3 eye = eyePoint(), ray = rayOf(tangentOf(middle));
  vec3 normal;
  const vec3 at = eye + solidHit(solid, eye, ray, normal) * ray;
  const float texel = scene.light_texel.x;
  const float light = lightVisibility(at + normal * (2.0 * texel), 2.5 * texel);
  const float lifted = scene.domain_min.w > 0.0 ? (at.y - scene.domain_min.y) / (scene.domain_max.y - scene.domain_min.y) : 1.0;
  const float open = mix(0.6, 1.0, smoothstep(0.0, 0.12, lifted));
  // Lit by the mean of four points of the pixel: a box's edges are smooth.
  vec3 lit = vec3(0.0);
  RILL_LOOP for (int k = 0; k < 4; ++k) {
    const vec2 offset = vec2(float(k & 1) - 0.5, float(k >> 1) - 0.5) * 0.5;
    vec3 facing = normal;
    if (solidHit(solid, eye, rayOf(tangentOf(middle + offset)), facing) < view.near_depth) facing = normal;
    lit += 0.25 * (ambient(facing) * open + kKey * (max(dot(facing, scene.light_to.xyz), 0.0) * light));
  }
  shaded[index] = packColor(view.unlit != 0u ? kPlainSolid * min(lit.g, 1.0) : (view.coloring != kBySpeed ? kSolidGray : kSolid) * lit);
  const bool sphere = solid.shape.kind == kShapeSphere;
  const vec3 center = vec3(solid.viewX, solid.viewY, solid.viewZ);
  rims[index] = sphere ? sphereRim(center, solid.radius, tangentOf(middle)) : rimByRays(solid, middle);
}
