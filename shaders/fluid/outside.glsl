// Projects centers out of solids. Needs `params`, solidAt(), nearSolidsAt() and meshWordAt().
#ifndef RILL_OUTSIDE_GLSL
#define RILL_OUTSIDE_GLSL
#define MESH_WORDS
#include "fluid/near_solids.glsl"
#include "shared/loops.glsl"
#include "shared/pose.glsl"
#include "shared/shape.glsl"

// PUSHED(k, solid, x, normal, by), if defined, is called where a solid moves a center from x and that `counts`.
#ifndef PUSHED
#define PUSHED(k, solid, x, normal, by)
#endif

// Moves a center out of the solids `near` it, where each will be `ahead` seconds from now, walls last.
// `counts`: x is a position, not a prediction, which bodies do not push. `pushed`: m that solids other than bodies moved it.
vec3 outside(vec3 x, NearSolids near, float ahead, bool counts, out float pushed) {
  pushed = 0.0;
  uint n = 0u, k;
  bool some = nextSolid(near, n, k);
  LOOP_WHILE (some) {
    SolidRecord s = solidAt(k);
    vec3 center = centerOf(s.pose) + ahead * velocityOf(s.pose);
    bool ignored = BODIES && !counts && s.body != kNoBody;  // the density that a body displaces is enough
    if (!ignored && !isBeyond(center, s.radius, x, params.margin + params.spacing)) {  // a sheet is thicker than its bounds
      PoseRecord pose = later(s.pose, ahead);
      vec3 normal;
      float distance = surfaceDistance(s.shape, localPoint(pose, x), normal);
      if (distance < params.margin) {
        vec3 outward = toScene(pose, normal), by = outward * (params.margin - distance);
        if (counts) { PUSHED(k, s, x, outward, by); }
        x += by;
        if (!BODIES || s.body == kNoBody) pushed += params.margin - distance;
      }
    }
    ++n;
    some = nextSolid(near, n, k);
  } LOOP_END(some);
  return insideWalls(x);
}
#endif
