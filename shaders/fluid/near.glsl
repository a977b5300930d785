// What walls and solids do to a particle near them, as walls.comp left it: two vectors a particle, 0 for those that are near nothing.
#ifndef RILL_NEAR_GLSL
#define RILL_NEAR_GLSL
#include "shared/arrays.glsl"
// Of particle i: the density that they displace and its gradient (gradient, value); its neighbours' push, in full.
#define READ_NEAR(BINDING) \
  READ_FLOAT4(BINDING, nearSample) \
  vec4 displacedAt(uint i) { return nearSampleAt(2u * i); } \
  vec3 pushShareAt(uint i) { return 1.0 - nearSampleAt(2u * i + 1u).xyz; }
#endif
