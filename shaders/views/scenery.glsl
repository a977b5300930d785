// Light on what stands around the fluid: the floor and the solids. Needs `scene` and `look`; positions are relative to the scene's origin.
#extension GL_EXT_samplerless_texture_functions : require
#include "render/sky.glsl"

layout(std430, set = 0, binding = 2) readonly buffer FluidShadow { uint fluid_shadow[]; };  // thickness towards the light, in look.finish.z
#ifdef SOLIDS
layout(set = 0, binding = 3) uniform texture2D light_depth;  // of the solids, from the light
#endif

vec2 lightTexel(vec3 p) {
  return vec2(dot(p, scene.light_u.xyz) - scene.light_u.w, dot(p, scene.light_v.xyz) - scene.light_v.w) / scene.light_texel.x;
}

float fluidThickness(ivec2 texel) {
  if (any(lessThan(texel, ivec2(0))) || texel.x >= int(scene.counts.y) || texel.y >= int(scene.counts.z)) return 0.0;
  return float(fluid_shadow[uint(texel.y) * scene.counts.y + uint(texel.x)]) * look.finish.z;
}

// What of the sun's light comes through the fluid.
vec3 throughFluid(vec3 p) {
  const vec2 at = lightTexel(p);
  if (any(lessThan(at, vec2(-2.0))) || any(greaterThan(at, vec2(scene.counts.yz) + 1.0))) return vec3(1.0);
  const ivec2 base = ivec2(floor(at));
  const vec2 part = at - floor(at);
  // Twice as wide as a texel is: the disc of the sun blurs the edge.
  float meters = 0.0;
  RILL_LOOP for (int y = -1; y <= 2; ++y)
    RILL_LOOP for (int x = -1; x <= 2; ++x) {
      const float wx = x == -1 ? 1.0 - part.x : (x == 2 ? part.x : 1.0), wy = y == -1 ? 1.0 - part.y : (y == 2 ? part.y : 1.0);
      meters += wx * wy * fluidThickness(base + ivec2(x, y));
    }
  meters /= 9.0;
  const float spread = 1.0 - exp(-meters / (2.0 * view.spacing));  // what the surface bends away
  return look.scatter.w > 0.0 ? vec3(1.0 - spread) : exp(-look.absorption.rgb * meters) * (1.0 - 0.45 * spread);
}

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

