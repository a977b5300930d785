// The light map: depth from the light on a grid square to it. Needs `scene`, `light_map`.
vec2 lightTexel(vec3 world) {
  return vec2(dot(world, scene.light_u.xyz) - scene.light_u.w, dot(world, scene.light_v.xyz) - scene.light_v.w) / scene.light_texel.x;
}
float lightDepth(vec3 world) { return scene.light_to.w - dot(world, scene.light_to.xyz); }

#ifdef LIGHT_MAP_READ
// How much of the light reaches a point, over four texels a side with smooth weights. `bias` m.
float lightVisibility(vec3 world, float bias) {
  const vec2 at = lightTexel(world);
  const vec2 base = floor(at);
  const vec2 part = at - base;
  const uint limit = floatBitsToUint(max(lightDepth(world) - bias, 0.0));
  float sum = 0.0;
  RILL_LOOP for (int y = -1; y <= 2; ++y) {
    const float wy = y == -1 ? 1.0 - part.y : (y == 2 ? part.y : 1.0);
    RILL_LOOP for (int x = -1; x <= 2; ++x) {
      const float wx = x == -1 ? 1.0 - part.x : (x == 2 ? part.x : 1.0);
      const ivec2 texel = ivec2(base) + ivec2(x, y);
      const bool inside = all(greaterThanEqual(texel, ivec2(0))) && texel.x < int(scene.counts.y) && texel.y < int(scene.counts.z);
      if (!inside || light_map[uint(texel.y) * scene.counts.y + uint(texel.x)] >= limit) sum += wx * wy;
    }
  }
  return sum / 9.0;
}
#endif
