// The samples around a particle, at the corners of a dodecahedron: see engine/sph/surface_tension.hpp.
#ifndef RILL_SURFACE_SAMPLES_GLSL
#define RILL_SURFACE_SAMPLES_GLSL
#include "shared/surface_tension.h"

// A number for each sample: four corners of a cube, the opposite four, four corners on edges, the opposite four, two and their opposites.
const uint kSampleParts = kTensionSamples / 4u;
struct Samples {
  vec4 part[kSampleParts];
};
#define EACH_PART(k) [[unroll]] for (uint k = 0u; k < kSampleParts; ++k)

Samples ofAll(float value) {
  Samples s;
  EACH_PART(k) s.part[k] = vec4(value);
  return s;
}

// `base` plus the dot product of each direction with v.
Samples along(vec3 v, float base) {
  vec4 cube = kTensionA * (v.x + vec4(v.y + v.z, v.y - v.z, v.z - v.y, -v.y - v.z));
  vec4 edge = kTensionB * vec4(v.y, v.y, v.z, -v.z) + kTensionC * vec4(v.z, -v.z, v.x, v.x);
  vec2 rest = kTensionB * v.x + kTensionC * vec2(v.y, -v.y);
  return Samples(vec4[](base + cube, base - cube, base + edge, base - edge, base + vec4(rest, -rest)));
}

float total(Samples s) {
  vec4 sum = vec4(0.0);
  EACH_PART(k) sum += s.part[k];
  return dot(sum, vec4(1.0));
}

// The sum of the directions, each times its number.
vec3 resultant(Samples s) {
  vec4 cube = s.part[0] - s.part[1], edge = s.part[2] - s.part[3];
  vec2 rest = s.part[4].xy - s.part[4].zw;
  return kTensionA * vec3(dot(cube, vec4(1)), dot(cube, vec4(1, 1, -1, -1)), dot(cube, vec4(1, -1, 1, -1))) +
         kTensionB * vec3(rest.x + rest.y, edge.x + edge.y, edge.z - edge.w) +
         kTensionC * vec3(edge.z + edge.w, rest.x - rest.y, edge.x - edge.y);
}

float sampleRadius = kTensionRadius * params.spacing;  // m
float inverseSquare = 1.0 / (kTensionSupport * kTensionSupport * params.spacing * params.spacing);
float alongApart = 2.0 * sampleRadius * inverseSquare, atCenter = 1.0 - sampleRadius * sampleRadius * inverseSquare;

// 1 - l^2, 0 beyond the support, of the samples around a particle that is at `apart` (m) from another, for that one.
Samples nearness(vec3 apart) {
  Samples s = along(alongApart * apart, atCenter - dot(apart, apart) * inverseSquare);
  EACH_PART(k) s.part[k] = max(s.part[k], vec4(0.0));
  return s;
}
#endif
