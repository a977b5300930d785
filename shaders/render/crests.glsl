// Fluid between a point and the sun: the highest particle and the number of particles in each cell of a grid across the sun's rays. The
// grid repeats, so that it needs no bounds. Needs look_records.h.
#ifndef RILL_CRESTS_GLSL
#define RILL_CRESTS_GLSL
#include "shared/ordered_floats.glsl"

const float kCrestCell = 2.0;   // spacings
const float kCrestRoom = 1.25;  // of a cell for its particles, since counts of a few vary

vec3 crestAcross(vec3 sun) { return normalize(abs(sun.y) < 0.99 ? vec3(-sun.z, 0.0, sun.x) : vec3(0.0, sun.z, -sun.y)); }
// In cells.
vec2 crestPlace(vec3 p, vec3 sun, float spacing) {
  const vec3 across = crestAcross(sun);
  return vec2(dot(across, p), dot(cross(sun, across), p)) / (kCrestCell * spacing);
}
uint crestIndex(ivec2 cell, uint side) { return (uint(cell.y) & (side - 1u)) * side + (uint(cell.x) & (side - 1u)); }
#endif
