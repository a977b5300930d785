// Rays against the solids. MESH_BINDING: there are meshes, with their fields in the buffer of this binding.
#include "shared/pose.glsl"
#ifdef MESH_BINDING
layout(std430, set = 0, binding = MESH_BINDING) readonly buffer MeshWords { uint mesh_words[]; };
uint meshWordAt(uint k) { return mesh_words[k]; }
const bool MESHES = true;
#define MESH_WORDS
#endif
#include "shared/shape.glsl"

// Distance along the ray, in lengths of `direction`, to where it enters the solid, and the outward normal; negative for a miss.
float solidHit(PlacedSolid solid, vec3 from, vec3 direction, out vec3 normal) {
  const float t = rayEntry(solid.shape, localPoint(solid.pose, from), toSolid(solid.pose, direction), normal);
  normal = toScene(solid.pose, normal);
  return t;
}
