// Bindings 0 and 1: the cell starts of the screen grid and the centers of surface particles.
#include "shared/arrays.glsl"
READ_UINT(0, start)
READ_FLOAT4(1, center)
