// Geometry of the shapes of solids, in the frame of the shape: relative to its center, before its rotation. MESH_WORDS: there may be
// meshes, if the constant MESHES is true; their words are meshWordAt(k).
#ifndef RILL_SHAPE_GLSL
#define RILL_SHAPE_GLSL
#include "shared/solid_records.h"
#ifdef MESH_WORDS
#include "shared/mesh_field.glsl"
#endif

vec3 halfExtents(ShapeRecord s) { return vec3(s.halfX, s.halfY, s.halfZ); }
vec3 middleOf(ShapeRecord s) { return vec3(s.middleX, s.middleY, s.middleZ); }

// Signed distance to the surface (negative inside) and the outward normal. Edges of boxes are round outside.
float surfaceDistance(ShapeRecord s, vec3 local, out vec3 normal) {
#ifdef MESH_WORDS
  if (MESHES && s.kind == kShapeMesh) {
    MeshSample mesh = meshSample(s.field, local);
    float slope = length(mesh.gradient);
    normal = slope > 1.0e-6 ? mesh.gradient / slope : vec3(0.0, 1.0, 0.0);
    return mesh.distance;
  }
#endif
  if (s.kind == kShapeSphere) {
    float r = length(local);
    normal = r > 1.0e-6 * s.halfX ? local / r : vec3(0.0, 1.0, 0.0);
    return r - s.halfX;
  }
  vec3 side = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(local, vec3(0.0)));
  vec3 beyond = abs(local) - halfExtents(s);
  vec3 out_ = max(beyond, vec3(0.0));
  float far = length(out_);
  if (far > 0.0) {
    normal = side * out_ / far;
    return far;
  }
  float most = max(beyond.x, max(beyond.y, beyond.z));
  normal = most == beyond.x ? vec3(side.x, 0.0, 0.0) : (most == beyond.y ? vec3(0.0, side.y, 0.0) : vec3(0.0, 0.0, side.z));
  return most;
}

#ifdef MESH_WORDS
// By steps as long as the distance: at most 128, after which a ray that grazes the mesh misses it.
float meshEntry(ShapeRecord s, vec3 from, vec3 along, out vec3 normal) {
  normal = vec3(0.0, 1.0, 0.0);
  float speed = length(along), shortest = 1.0e-4 * length(halfExtents(s));
  vec3 unit = along / speed, safe = mix(unit, vec3(1.0e-12), lessThan(abs(unit), vec3(1.0e-12)));
  float edge = meshFloatAt(s.field + kFieldEdge);  // the surface of a sheet is outside its bounds, within less than a block
  vec3 a = (middleOf(s) - halfExtents(s) - edge - from) / safe, b = (middleOf(s) + halfExtents(s) + edge - from) / safe;
  vec3 near = min(a, b), far = max(a, b);
  float t = max(max(near.x, max(near.y, near.z)), 0.0), end = min(far.x, min(far.y, far.z));
  bool hit = false;
  for (uint k = 0u; k < 128u && t <= end && !hit; ++k) {
    float distance = meshSample(s.field, from + t * unit).distance;
    hit = distance < shortest;
    if (!hit) t += distance;
  }
  if (!hit || t <= 0.0) return -1.0;
  vec3 gradient = meshSample(s.field, from + t * unit).gradient;
  normal = normalize(length(gradient) > 1.0e-6 ? gradient : -unit);
  return t / speed;
}
#endif

// Where a ray enters, in lengths of `along`, and the outward normal there; negative for a miss.
float rayEntry(ShapeRecord s, vec3 from, vec3 along, out vec3 normal) {
  normal = vec3(0.0, 1.0, 0.0);
  if (s.kind == kShapeMesh) {
#ifdef MESH_WORDS
    if (MESHES) return meshEntry(s, from, along, normal);
#endif
    return -1.0;
  }
  if (s.kind == kShapeSphere) {
    float inverse = 1.0 / dot(along, along), middle = -dot(from, along) * inverse;
    vec3 miss = from + middle * along;
    float inside = s.halfX * s.halfX - dot(miss, miss);
    if (inside <= 0.0) return -1.0;
    float t = middle - sqrt(inside * inverse);
    normal = (from + t * along) / s.halfX;
    return t;
  }
  vec3 half_ = halfExtents(s), side = mix(vec3(1.0), vec3(-1.0), lessThan(along, vec3(0.0)));
  vec3 step = side * max(abs(along), vec3(1.0e-12));
  vec3 near = (-side * half_ - from) / step, far = (side * half_ - from) / step;
  float enter = max(near.x, max(near.y, near.z));
  if (enter > min(far.x, min(far.y, far.z))) return -1.0;
  normal = enter == near.x ? vec3(-side.x, 0.0, 0.0) : (enter == near.y ? vec3(0.0, -side.y, 0.0) : vec3(0.0, 0.0, -side.z));
  return enter;
}
#endif
