// Bindings 2 to 5 of the passes over neighbors: the particles gathered from, the neighbor list, its
// heads and the cell keys. Particles of the array `work` (PARTICLE uvec4) hold halves beside floats: as words, since a float that they
// happen to make may be denormal, which a device may flush to zero.
#ifndef RILL_FLUID_ARRAYS_GLSL
#define RILL_FLUID_ARRAYS_GLSL
#include "shared/arrays.glsl"
#ifdef PARTICLE
READ_UINT4(2, particle)
#else
#define PARTICLE vec4
READ_FLOAT4(2, particle)
#endif
READ_UINT2(3, list)
READ_UINT(4, listHead)
READ_UINT(5, cell)
#endif
