// The difference of each particle's velocity from the kernel's mean around it, which XSPH removes
// (Schechter and Bridson 2012; Macklin and Mueller 2013, equation 17). Include it after the neighbors' array
// `sweepFrom` is declared. The pairs are those of the density pass: gathers from `work`.
#ifndef RILL_FLUID_XSPH_GLSL
#define RILL_FLUID_XSPH_GLSL
#include "fluid/cluster.glsl"
#include "fluid/kernel.glsl"

#define COMPANION(j) sweepFromAt(j)

vec3 here;
vec4 own;
vec3 change = vec3(0.0);

void visit(vec4 particle, vec4 companion) {
  vec3 r = here - particle.xyz;
  change += kernelShape(sqrt(dot(r, r))) * (companion.xyz - own.xyz);
}
void reflectSums(vec3 signs) {  // images move as in a mirror
  change *= signs;
  own.xyz *= signs;
}
#define IMAGES
#include "fluid/neighbors.glsl"

// The kernel's mean of the neighbors' values less the particle's own.
vec3 meanDifference(uint i, uint local, bool inRange) {
  here = particleAt(i).xyz;
  own = sweepFromAt(i);
  visitNeighbors(i, headOf(i, inRange), local, inRange);
  return params.valueScale * change;
}
#endif
