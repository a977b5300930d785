// Solids hold diffuse particles back. Declare WHITE_SOLIDS and WHITE_MESHES, two bindings, before including this; without them there are
// no solids.
#ifndef RILL_WHITE_SOLIDS_GLSL
#define RILL_WHITE_SOLIDS_GLSL
float clearance() { return kWhiteClearance * white.spacing; }

#ifdef WHITE_SOLIDS
layout(constant_id = 0) const bool MESHES = false;
#include "shared/solid_records.h"
layout(std430, set = 0, binding = WHITE_SOLIDS) readonly buffer Solids { SolidRecord solids[]; };
layout(std430, set = 0, binding = WHITE_MESHES) readonly buffer MeshWords { uint mesh_words[]; };
uint meshWordAt(uint k) { return mesh_words[k]; }
#define MESH_WORDS
#include "shared/pose.glsl"
#include "shared/shape.glsl"

// Distance of a point from a solid that it is within `reach` of, and the outward normal.
bool nearSolid(uint k, vec3 x, float reach, out float distance_, out vec3 normal) {
  distance_ = reach;
  normal = vec3(0.0);
  if (isBeyond(centerOf(solids[k].pose), solids[k].radius, x, reach + white.spacing)) return false;  // a sheet is thicker than its bounds
  distance_ = surfaceDistance(solids[k].shape, localPoint(solids[k].pose, x), normal);
  normal = toScene(solids[k].pose, normal);
  return distance_ < reach;
}

// The kernel's share outside of the solids, taken for planes.
float shareOutside(vec3 x) {
  float share = 1.0, away;
  vec3 normal;
  for (uint k = 0u; k < white.solids; ++k)
    if (nearSolid(k, x, support(), away, normal)) share *= shareWithin(away / support());
  return share;
}

// What solids add to the slope of the fluid's share if they count as fluid.
vec3 slopeOfSolids(vec3 x) {
  vec3 slope = vec3(0.0), normal;
  float away;
  for (uint k = 0u; k < white.solids; ++k)
    if (nearSolid(k, x, support(), away, normal)) slope -= shareSlope(away / support()) * normal;
  return slope;
}

bool insideSolid(vec3 x) {
  float away;
  vec3 normal;
  bool inside = false;
  for (uint k = 0u; k < white.solids; ++k) inside = inside || nearSolid(k, x, 0.0, away, normal);
  return inside;
}

// Of a particle that goes from `x` to `to` in so many seconds: puts it on the first surface of each solid that it meets, and takes the
// part of its velocity that leads into the solid. Whether there was one.
bool holdBack(vec3 x, inout vec3 to, inout vec3 v, float seconds) {
  bool met = false;
  for (uint k = 0u; k < white.solids; ++k) {
    const PoseRecord pose = solids[k].pose;
    const float radius = solids[k].radius + white.spacing;
    const float reach = distance(x, to) + seconds * (length(velocityOf(pose)) + radius * length(angularVelocity(pose)));
    if (isBeyond(centerOf(pose), radius, to, reach)) continue;
    // In the solid's frame the particle moves in a straight line
    const vec3 from = localPoint(later(pose, -seconds), x);
    vec3 at = localPoint(pose, to), normal;
    const vec3 along = at - from;
    float away = surfaceDistance(solids[k].shape, at, normal);
    bool hit = away < 0.0;
    if (away < length(along)) {
      vec3 face;
      const float entry = rayEntry(solids[k].shape, from, along, face);
      if (entry >= 0.0 && entry <= 1.0) {
        hit = true;
        at = from + entry * along;
        away = surfaceDistance(solids[k].shape, at, normal);
      }
    }
    if (!hit) continue;
    met = true;
    to = centerOf(pose) + toScene(pose, at + (clearance() - away) * normal);
    normal = toScene(pose, normal);
    v -= min(dot(v - velocityAt(pose, to), normal), 0.0) * normal;
  }
  return met;
}
#else
float shareOutside(vec3 x) { return 1.0; }
vec3 slopeOfSolids(vec3 x) { return vec3(0.0); }
bool insideSolid(vec3 x) { return false; }
bool holdBack(vec3 x, inout vec3 to, inout vec3 v, float seconds) { return false; }
#endif
#endif
