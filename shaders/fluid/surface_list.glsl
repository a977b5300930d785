// The list of particles near surfaces, which is made in each substep, in any order, and the forces on particles, as integers, so
// that their order does not matter.
#ifndef RILL_SURFACE_LIST_GLSL
#define RILL_SURFACE_LIST_GLSL
#include "shared/surface_tension.h"

// Where the number of those of the chunk that begins at particle `first` is. They are listed from `first` on.
uint surfaceCounter(uint first) { return params.capacity + first / params.chunkParticles; }
#endif
