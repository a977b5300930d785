// What substeps do with a particle, by the region that it is in. Needs `params` and `regions`.
#ifndef RILL_ZONES_GLSL
#define RILL_ZONES_GLSL
#include "fluid/regions.glsl"
uint zoneOf(vec3 x) { return isActive(x) ? regions[regionIndex(regionOf(x))].zone : kZoneMoves; }
#endif
