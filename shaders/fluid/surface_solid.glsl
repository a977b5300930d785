// Of surface tension: the solid nearest to a particle, whose surface's plane acts on its samples. Needs `params`, nearSolidsOf() and
// solidAt().
#ifndef RILL_SURFACE_SOLID_GLSL
#define RILL_SURFACE_SOLID_GLSL

struct SurfaceSolid {
  uint index;   // kNoSolid: none
  vec4 plane;   // xyz: away from the solid, w: distance in m
  vec3 center;  // of the solid, m
};

SurfaceSolid surfaceSolidAt(NearSolids near, vec3 x) {
  SurfaceSolid nearest = SurfaceSolid(kNoSolid, vec4(0.0, 1.0, 0.0, kNoWall), vec3(0.0));
  for (uint m = 0u, k; nextSolid(near, m, k); ++m) {
    SolidRecord s = solidAt(k);
    vec3 normal;
    float distance = surfaceDistance(s.shape, localPoint(s.pose, x), normal);
    if (distance < nearest.plane.w) nearest = SurfaceSolid(k, vec4(toScene(s.pose, normal), distance), centerOf(s.pose));
  }
  return nearest;
}
#endif
