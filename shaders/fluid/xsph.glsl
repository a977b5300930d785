// The difference of the kernel's mean of `sweepFrom` from a particle's own, sum_j K_ij (v_j - v_i), which XSPH
// adds (Schechter and Bridson 2012; Macklin and Mueller 2013, equation 17). The pairs are those of the density
// pass: gathers from `work`. Include it after `push` and `sweepFrom` are declared. Images move as in a
// mirror, also where fluid sticks to walls.
#ifndef RILL_FLUID_XSPH_GLSL
#define RILL_FLUID_XSPH_GLSL
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/kernel.glsl"

#define COMPANION(j) sweepFromAt(j)

vec3 here;
vec4 own;
uint head, fluid;
vec3 difference = vec3(0.0);  // over params.valueScale until it is gathered

void visit(uvec4 particle, vec4 companion) {
  vec3 r = here - uintBitsToFloat(particle.xyz);
  float weight = kernelShape(sqrt(dot(r, r)));
  if (fluidOfWork(particle) != fluid) weight = 0.0;  // the velocities of two fluids differ along their interface
  difference += weight * (companion.xyz - own.xyz);
}
void reflectSums(vec3 signs) {
  difference *= signs;
  own.xyz *= signs;
}
#define IMAGES
#include "fluid/gather.glsl"

// Gathers `own` and `difference` of the invocation's particle i; false where it has none. A difference of 0 for one that sleeps.
bool gatherDifference(out uint i) {
  bool inRange = gather(i);
  difference *= params.valueScale;
  return inRange;
}
#endif
