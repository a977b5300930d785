// Adds to the sums of solids what they displace particles by. Needs `params` and the storage array `solidSums`.
#ifndef RILL_SOLID_REACTION_GLSL
#define RILL_SOLID_REACTION_GLSL
#include "fluid/solid_sums.glsl"

// Of a displacement (m) that a solid with this center gives a particle, whose reaction acts at `at`, as units of the six components.
void toUnits(vec3 center, vec3 displacement, vec3 at, out float units[kLoadComponents]) {
  vec3 linear = displacement / (params.spacing * kDisplacementUnits);
  vec3 angular = cross(at - center, linear) / params.loadLever;
  for (int a = 0; a < 3; ++a) {
    units[a] = linear[a];
    units[a + 3] = angular[a];
  }
}

void addToSolid(uint k, vec3 center, vec3 displacement, vec3 at) {
  if (displacement == vec3(0.0)) return;
  float units[kLoadComponents];
  toUnits(center, displacement, at, units);
  for (uint c = 0u; c < kLoadComponents; ++c) {
    int high;
    uint low;
    split(units[c], high, low);
    addWide(k * kSolidSumWords + kSolveSums + 2u * c, high, low);
  }
}
#endif
