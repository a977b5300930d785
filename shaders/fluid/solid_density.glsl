// The density that a solid displaces, from the tables of engine/sph/solid_density.hpp and the fields of engine/sph/mesh_field.hpp.
// Needs `params`, tableAt(k), shared/pose.glsl and shared/shape.glsl.
#ifndef RILL_SOLID_DENSITY_GLSL
#define RILL_SOLID_DENSITY_GLSL
#include "fluid/half_space.glsl"

// A box displaces the product of its slabs, a ball what its own table says, a mesh what a half-space does times a factor. `distance`: of x
// from the surface, or less.
vec4 solidSample(SolidRecord s, vec3 x, out float distance) {
  vec3 local = localPoint(s.pose, x);
  if (MESHES && s.shape.kind == kShapeMesh) {
    MeshSample mesh = meshSample(s.shape.field, local);
    distance = mesh.distance;
    vec2 f = face(distance);
    return vec4(toScene(s.pose, f.y * mesh.factor * mesh.gradient + f.x * mesh.factorGradient), f.x * mesh.factor);
  }
  if (s.shape.kind == kShapeSphere) {
    vec3 normal;
    distance = surfaceDistance(s.shape, local, normal);
    vec2 f = line(s.tableOffset, s.tableNodes, distance - s.tableFirst);
    return vec4(toScene(s.pose, normal * f.y), f.x);
  }
  vec3 half_ = halfExtents(s.shape), slab, slope, beyond = abs(local) - half_;
  distance = max(beyond.x, max(beyond.y, beyond.z));
  if (distance > params.support) return vec4(0.0);
  for (int a = 0; a < 3; ++a) {
    vec2 near = face(local[a] - half_[a]), far = face(local[a] + half_[a]);
    slab[a] = near.x - far.x;
    slope[a] = near.y - far.y;
  }
  vec3 gradient = vec3(slope.x * slab.y * slab.z, slab.x * slope.y * slab.z, slab.x * slab.y * slope.z);
  return vec4(toScene(s.pose, gradient), slab.x * slab.y * slab.z);
}

vec4 solidSample(SolidRecord s, vec3 x) {
  float distance;
  return solidSample(s, x, distance);
}

// How much of a solid's image counts, which has x at `image`: of a solid that reaches through a wall the part behind it
// counts itself, so that its image fades within a spacing.
float shareOfImage(SolidRecord s, vec3 image) {
  if (all(greaterThanEqual(image, wallsLow())) && all(lessThanEqual(image, wallsHigh()))) return 1.0;
  vec3 half_ = halfExtents(s.shape), reach = vec3(0.0);  // along the scene's axes
  for (int a = 0; a < 3; ++a) {
    vec3 edge = vec3(0.0);
    edge[a] = half_[a];
    reach += abs(toScene(s.pose, edge));
  }
  if (s.shape.kind == kShapeSphere) reach = vec3(s.shape.halfX);
  vec3 low = wallsLow(), high = wallsHigh(), middle = centerOf(s.pose) + toScene(s.pose, middleOf(s.shape));
  vec3 through = mix(vec3(0.0), low - (middle - reach), lessThan(image, low));
  through = mix(through, middle + reach - high, greaterThan(image, high));
  vec3 share = 1.0 - clamp(through / params.spacing, vec3(0.0), vec3(1.0));
  return share.x * share.y * share.z;
}
#endif
