// Projects centers out of solids. Needs `params` and the storage array `solids`.
#ifndef RILL_OUTSIDE_GLSL
#define RILL_OUTSIDE_GLSL
#include "fluid/solids.glsl"

// Moves a center out of every solid, where each will be `ahead` seconds from now, walls last.
// `pushed`: m that solids moved it.
vec3 outside(vec3 x, float ahead, out float pushed) {
  pushed = 0.0;
  for (uint k = 0u; k < params.solidCount; ++k) {
    SolidRecord s = solids[k];
    s.centerX += ahead * s.velocityX;
    s.centerY += ahead * s.velocityY;
    s.centerZ += ahead * s.velocityZ;
    vec3 normal;
    float distance = surfaceDistance(s, toLocal(s, x), normal);
    if (distance < params.margin) {
      x += toWorld(s, normal) * (params.margin - distance);
      pushed += params.margin - distance;
    }
  }
  return insideWalls(x);
}
#endif
