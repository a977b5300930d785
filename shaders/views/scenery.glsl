// Light on what stands around the fluid: the floor and the solids. Needs `scene` and `look`; positions are relative to the scene's origin.
#extension GL_EXT_samplerless_texture_functions : require
#include "render/sky.glsl"
#include "render/fluid_bodies.glsl"
#include "shared/arrays.glsl"

#ifdef CAUSTICS
#include "render/caustics_records.h"
READ_UINT2(2, caustics)  // of Caustics::addTo()
#else
READ_FLOAT(2, fluid_shadow)  // of fluid_shadow.comp
#endif
#ifdef SOLIDS
layout(set = 0, binding = 3) uniform texture2D light_depth;  // of the solids, from the light
#endif

vec2 lightTexel(vec3 p) {
  return vec2(dot(p, scene.light_u.xyz) - scene.light_u.w, dot(p, scene.light_v.xyz) - scene.light_v.w) / scene.light_texel.x;
}

#ifndef CAUSTICS
// What of the sun's light comes through the fluid.
vec3 throughFluid(vec3 p) {
  const vec2 at = lightTexel(p);
  if (any(lessThan(at, vec2(-2.0))) || any(greaterThanEqual(at, vec2(scene.counts.yz) + 1.0))) return vec3(1.0);
  const ivec2 border = ivec2(kShadowBorder), size = ivec2(scene.counts.yz) + 2 * border;
  const vec2 part = at - floor(at);
  const ivec2 base = clamp(ivec2(floor(at)) + border, ivec2(0), size - 2);
  float meters = 0.0;
  vec3 depth = vec3(0.0), back = vec3(0.0);
  for (uint fluid = 0u; fluid < FLUIDS; ++fluid) {
    const uint first = (fluid * uint(size.y) + uint(base.y)) * uint(size.x) + uint(base.x), second = first + uint(size.x);
    const float own = mix(mix(fluid_shadowAt(first), fluid_shadowAt(first + 1u), part.x),
                          mix(fluid_shadowAt(second), fluid_shadowAt(second + 1u), part.x), part.y);
    meters += own;
    depth += absorptionOf(fluid) * own;
    if (FLUIDS > 1u) back += absorptionOf(fluid) * own * scatterOf(fluid);
  }
  const float spread = 1.0 - exp(-meters / (2.0 * view.spacing));  // what the surface bends away
  if (look.scatter.w > 0.0) return vec3(1.0 - spread);
  // A layer that scatters lets 1 / (1 + 3/4 of its optical depth) through (diffusion, two streams), most of it from all directions.
  const vec3 color = FLUIDS == 1u ? look.scatter.rgb : back / max(depth, vec3(1e-20)), straight = exp(-depth);
  return straight * (1.0 - 0.45 * spread) + color * max(1.0 / (1.0 + 0.75 * depth) - straight, vec3(0.0));
}
#endif

// How much of the sun the solids let through, over nine texels.
float pastSolids(vec3 p, float bias) {
#ifdef SOLIDS
  const vec2 at = lightTexel(p);
  const ivec2 base = ivec2(floor(clamp(at, vec2(-8.0), vec2(8192.0))));
  const vec2 part = at - floor(at);
  const float own = scene.light_to.w - dot(p, scene.light_to.xyz) - bias;
  float sum = 0.0;
  RILL_LOOP for (int y = -1; y <= 2; ++y)
    RILL_LOOP for (int x = -1; x <= 2; ++x) {
      const float wx = x == -1 ? 1.0 - part.x : (x == 2 ? part.x : 1.0), wy = y == -1 ? 1.0 - part.y : (y == 2 ? part.y : 1.0);
      const ivec2 texel = base + ivec2(x, y);
      const bool inside = all(greaterThanEqual(texel, ivec2(0))) && texel.x < int(scene.counts.y) && texel.y < int(scene.counts.z);
      const float stored = inside ? texelFetch(light_depth, texel, 0).r : 1.0;
      if (stored >= 1.0 || stored * scene.light_texel.y >= own) sum += wx * wy;
    }
  return sum / 9.0;
#else
  return 1.0;
#endif
}

// What of the sun's light reaches a point of a solid or of the floor, seen in pixels `width` m wide.
#ifdef CAUSTICS
#ifdef SOLIDS
const uint kCausticLayers = 2u;
#else
const uint kCausticLayers = 1u;
#endif

// Light through the fluid, and the share that meets none, in a texel of a level of this size whose first one is `first`.
vec4 causticTexel(ivec2 texel, uint first, ivec2 size, bool solid, float depth) {
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, size))) return vec4(0.0, 0.0, 0.0, 1.0);
  const uint own = first + uint(texel.y * size.x + texel.x);
  const uvec2 own_texel = causticsAt(own);
  const vec4 light = vec4(unpackHalf2x16(own_texel.x), unpackHalf2x16(own_texel.y));
#ifdef SOLIDS
  if (solid) {
    const uvec2 packed = causticsAt(own + uint(size.x * size.y));
    const vec4 on_solid = vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y));
    return vec4(on_solid.rgb, on_solid.a < depth ? light.a : 1.0);
  }
#endif
  return light;
}

vec4 causticLevel(vec2 at, uint first, ivec2 size, bool solid, float depth) {
  const ivec2 base = ivec2(floor(at));
  const vec2 part = at - vec2(base);
  const vec4 a = causticTexel(base, first, size, solid, depth);
  const vec4 b = causticTexel(base + ivec2(1, 0), first, size, solid, depth);
  const vec4 c = causticTexel(base + ivec2(0, 1), first, size, solid, depth);
  const vec4 d = causticTexel(base + ivec2(1, 1), first, size, solid, depth);
  return mix(mix(a, b, part.x), mix(c, d, part.x), part.y);
}

vec3 reaching(vec3 sun, vec3 p, float bias, float width, bool solid) {
  const vec2 at = lightTexel(p);
  const float past = pastSolids(p, bias);
  if (any(lessThan(at, vec2(-2.0))) || any(greaterThan(at, vec2(scene.counts.yz) + 1.0))) return sun * past;
  ivec2 size = int(kCausticFine) * ivec2(scene.counts.yz);
  const float texels = max(width * float(kCausticFine) / scene.light_texel.x, 1.0);
  const float detail = min(log2(texels), float(kCausticLevels - 1u)), part = fract(detail);
  const float depth = scene.light_to.w - dot(p, scene.light_to.xyz) - 0.5 * view.spacing;
  vec2 place = (at + 0.5) * float(kCausticFine) + 0.5;  // texels are half of one before those of photons
  uint first = 0u;
  // Levels up to the one of this detail, which is mixed with the next
  vec4 light = vec4(0.0);
  RILL_LOOP for (int k = 0; k < int(kCausticLevels); ++k) {
    const float share = k == int(detail) ? 1.0 - part : (k == int(detail) + 1 ? part : 0.0);
    if (share > 0.0) light += share * causticLevel(place - 0.5, first, size, solid, depth);
    if (float(k) >= detail) break;
    first += kCausticLayers * uint(size.x * size.y);
    size = (size + 1) / 2;
    place *= 0.5;
  }
  return sun * (solid ? past * (light.a + light.rgb) : past * light.a + light.rgb);
}
#else
vec3 reaching(vec3 sun, vec3 p, float bias, float width, bool solid) { return sun * pastSolids(p, bias) * throughFluid(p); }
#endif
