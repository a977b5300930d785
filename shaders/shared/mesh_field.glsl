// The field of a mesh at a point of the mesh's frame. Needs meshWordAt(k), the words of all fields.
#ifndef RILL_MESH_FIELD_GLSL
#define RILL_MESH_FIELD_GLSL
#include "shared/mesh_field.h"

struct MeshSample {
  float distance;       // m, negative inside
  vec3 gradient;        // of the distance
  float factor;         // displaced density over that of a half-space at this distance
  vec3 factorGradient;  // 1/m
};

float meshFloatAt(uint k) { return uintBitsToFloat(meshWordAt(k)); }

// Distance and factor of a node; coarse ones have a distance alone.
vec2 meshNodeAt(uint k, bool fine, float range) {
  uint word = meshWordAt(k);
  return fine ? unpackSnorm2x16(word) * vec2(range, kFieldFactorRange) + vec2(0.0, 1.0) : vec2(uintBitsToFloat(word), 1.0);
}

MeshSample meshSample(uint field, vec3 local) {
  uvec3 blocks = uvec3(meshWordAt(field + kFieldBlocks), meshWordAt(field + kFieldBlocks + 1u), meshWordAt(field + kFieldBlocks + 2u));
  vec3 low = vec3(meshFloatAt(field + kFieldLow), meshFloatAt(field + kFieldLow + 1u), meshFloatAt(field + kFieldLow + 2u));
  float edge = meshFloatAt(field + kFieldEdge), range = meshFloatAt(field + kFieldRange);
  vec3 inside = clamp(local, low, low + edge * vec3(blocks)), beyond = local - inside;
  vec3 at = (inside - low) / edge;
  uvec3 block = min(uvec3(at), blocks - 1u);
  vec3 t = clamp(at - vec3(block), 0.0, 1.0);
  uint own = meshWordAt(field + meshWordAt(field + kFieldFine) + (block.z * blocks.y + block.y) * blocks.x + block.x);
  bool fine = own != kFieldCoarse;
  uint row = blocks.x + 1u, layer = row * (blocks.y + 1u);
  uint first = field + meshWordAt(field + kFieldCorners) + block.z * layer + block.y * row + block.x;
  if (fine) {
    t *= float(kFieldCells);
    uvec3 cell = min(uvec3(t), uvec3(kFieldCells - 1u));
    t -= vec3(cell);
    row = kFieldNodes;
    layer = kFieldNodes * kFieldNodes;
    first = field + own + cell.z * layer + cell.y * row + cell.x;
  }
  // Trilinear interpolation between eight nodes, and its derivatives.
  vec2 a = meshNodeAt(first, fine, range), b = meshNodeAt(first + 1u, fine, range);
  vec2 c = meshNodeAt(first + row, fine, range), d = meshNodeAt(first + row + 1u, fine, range);
  first += layer;
  vec2 e = meshNodeAt(first, fine, range), f = meshNodeAt(first + 1u, fine, range);
  vec2 g = meshNodeAt(first + row, fine, range), h = meshNodeAt(first + row + 1u, fine, range);
  vec2 dx = mix(mix(b - a, d - c, t.y), mix(f - e, h - g, t.y), t.z);
  a = mix(a, b, t.x);
  c = mix(c, d, t.x);
  e = mix(e, f, t.x);
  g = mix(g, h, t.x);
  vec2 dy = mix(c - a, g - e, t.z), low_ = mix(a, c, t.y), high = mix(e, g, t.y), value = mix(low_, high, t.z), dz = high - low_;
  float perMeter = (fine ? float(kFieldCells) : 1.0) / edge;
  MeshSample s = MeshSample(value.x, perMeter * vec3(dx.x, dy.x, dz.x), value.y, perMeter * vec3(dx.y, dy.y, dz.y));
  float far = length(beyond);
  if (far > 0.0) s = MeshSample(s.distance + far, beyond / far, 1.0, vec3(0.0));
  return s;
}
#endif
