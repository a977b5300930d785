// Projects centers out of solids. Needs `params`, the storage array `solids` and meshWordAt().
#ifndef RILL_OUTSIDE_GLSL
#define RILL_OUTSIDE_GLSL
#define MESH_WORDS
#include "fluid/near_solids.glsl"
#include "shared/pose.glsl"
#include "shared/shape.glsl"

// PUSHED(k, x, normal, by), if defined, is called where solid k moves a center from x.
#ifndef PUSHED
#define PUSHED(k, x, normal, by)
#endif

// Moves a center out of the solids `near` it, where each will be `ahead` seconds from now, walls last.
// `pushed`: m that solids moved it.
vec3 outside(vec3 x, uvec3 near, float ahead, out float pushed) {
  pushed = 0.0;
  for (uint n = 0u, k; nextSolid(near, n, k); ++n) {
    if (BODIES && ahead > 0.0 && solids[k].body != kNoBody) continue;  // the density that a body displaces is enough
    vec3 center = centerOf(solids[k].pose) + ahead * velocityOf(solids[k].pose);
    if (isBeyond(center, solids[k].radius, x, params.margin + params.spacing)) continue;  // a sheet is thicker than its bounds
    PoseRecord pose = later(solids[k].pose, ahead);
    vec3 normal;
    float distance = surfaceDistance(solids[k].shape, localPoint(pose, x), normal);
    if (distance < params.margin) {
      vec3 outward = toScene(pose, normal), by = outward * (params.margin - distance);
      PUSHED(k, x, outward, by);
      x += by;
      pushed += params.margin - distance;
    }
  }
  return insideWalls(x);
}
#endif
