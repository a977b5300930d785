// Bindings 2 to 5 of the passes over neighbors: the particles gathered from, the neighbor list, its
// counts and the cell keys.
#ifndef RILL_FLUID_ARRAYS_GLSL
#define RILL_FLUID_ARRAYS_GLSL
#include "shared/arrays.glsl"
READ_FLOAT4(2, particle)
READ_UINT4(3, list)
READ_UINT(4, neighborCount)
READ_UINT(5, cell)
#endif
