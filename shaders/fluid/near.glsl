// What walls and solids do to a particle near them: two vectors a particle in one array, both 0 for whoever is near nothing.
#ifndef RILL_NEAR_GLSL
#define RILL_NEAR_GLSL
#include "shared/arrays.glsl"
#define NEAR_DISPLACED(i) (2u * (i))         // density that they displace: gradient; w: value
#define NEAR_ALONG(i) (2u * (i) + 1u)        // by how much more than the neighbors' push along each axis must be: 0 for no more
#define READ_NEAR(BINDING) \
  READ_FLOAT4(BINDING, nearSample) \
  vec4 displacedAt(uint i) { return nearSampleAt(NEAR_DISPLACED(i)); } \
  vec3 alongWallsAt(uint i) { return 1.0 + nearSampleAt(NEAR_ALONG(i)).xyz; }
#endif
