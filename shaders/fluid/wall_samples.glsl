// Density displaced by walls and solids, two vectors a particle in one array; both are 0 away from walls and solids.
#ifndef RILL_WALL_SAMPLES_GLSL
#define RILL_WALL_SAMPLES_GLSL
#include "shared/arrays.glsl"
#define NEAR_DISPLACED(i) (2u * (i))         // gradient of the displaced density; w: its value
#define NEAR_TANGENTIAL(i) (2u * (i) + 1u)        // extra tangential scale for the support that is missing behind walls
#define READ_NEAR(BINDING) \
  READ_FLOAT4(BINDING, nearSample) \
  vec4 displacedAt(uint i) { return nearSampleAt(NEAR_DISPLACED(i)); } \
  vec3 tangentialScaleAt(uint i) { return 1.0 + nearSampleAt(NEAR_TANGENTIAL(i)).xyz; }
#endif
