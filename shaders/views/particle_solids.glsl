// Rays against the solids.
#include "shared/pose.glsl"
#include "shared/shape.glsl"

// Distance along the ray, in lengths of `direction`, to where it enters the solid, and the outward normal; negative for a miss.
float solidHit(PlacedSolid solid, vec3 from, vec3 direction, out vec3 normal) {
  const float t = rayEntry(solid.shape, localPoint(solid.pose, from), toSolid(solid.pose, direction), normal);
  normal = toScene(solid.pose, normal);
  return t;
}
