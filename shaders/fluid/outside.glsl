// Projects centers out of solids. Needs `params`, solidAt(), nearSolidsAt() and meshWordAt().
#ifndef RILL_OUTSIDE_GLSL
#define RILL_OUTSIDE_GLSL
#define MESH_WORDS
#include "fluid/near_solids.glsl"
#include "shared/pose.glsl"
#include "shared/shape.glsl"

// PUSHED(k, solid, x, normal, by), if defined, is called where a solid moves a center from x.
#ifndef PUSHED
#define PUSHED(k, solid, x, normal, by)
#endif

// Moves a center out of the solids `near` it, where each will be `ahead` seconds from now, walls last.
// `pushed`: m that solids moved it.
vec3 outside(vec3 x, NearSolids near, float ahead, out float pushed) {
  pushed = 0.0;
  for (uint n = 0u, k; nextSolid(near, n, k); ++n) {
    SolidRecord s = solidAt(k);
    if (BODIES && ahead > 0.0 && s.body != kNoBody) continue;  // the density that a body displaces is enough
    vec3 center = centerOf(s.pose) + ahead * velocityOf(s.pose);
    if (isBeyond(center, s.radius, x, params.margin + params.spacing)) continue;  // a sheet is thicker than its bounds
    PoseRecord pose = later(s.pose, ahead);
    vec3 normal;
    float distance = surfaceDistance(s.shape, localPoint(pose, x), normal);
    if (distance < params.margin) {
      vec3 outward = toScene(pose, normal), by = outward * (params.margin - distance);
      PUSHED(k, s, x, outward, by);
      x += by;
      pushed += params.margin - distance;
    }
  }
  return insideWalls(x);
}
#endif
