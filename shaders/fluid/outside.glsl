// Projects centers out of solids. Needs `params`, the storage array `solids` and meshWordAt().
#ifndef RILL_OUTSIDE_GLSL
#define RILL_OUTSIDE_GLSL
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"

// Moves a center out of every solid, where each will be `ahead` seconds from now, walls last.
// `pushed`: m that solids moved it.
vec3 outside(vec3 x, float ahead, out float pushed) {
  pushed = 0.0;
  for (uint k = 0u; k < params.solidCount; ++k) {
    PoseRecord pose = later(solids[k].pose, ahead);
    vec3 normal;
    float distance = surfaceDistance(solids[k].shape, localPoint(pose, x), normal);
    if (distance < params.margin) {
      x += toScene(pose, normal) * (params.margin - distance);
      pushed += params.margin - distance;
    }
  }
  return insideWalls(x);
}
#endif
