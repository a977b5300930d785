// The rate of change of concentrations by diffusion but for params.diffusionRate, sum_j w_ij (c_j - c_i), w = (1 - q)^3 of the distance
// over the support. The sum over both of a pair is 0, so that what there is of each fluid is kept. The pairs are those of the density
// pass: gathers from `work`. Include it after `push` is declared, with COMPANION(j) the concentrations of j. ROWS: also sums the weights.
// A mirror image has its particle's concentrations: nothing goes through a wall.
#ifndef RILL_DIFFUSION_RATE_GLSL
#define RILL_DIFFUSION_RATE_GLSL
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"

float inverseSupport = params.inverseSupport;  // loaded once, see kernel.glsl
vec3 here;
vec4 own;
uint head, fluid;
vec4 exchange = vec4(0.0);
#ifdef ROWS
float row = 0.0;
#endif

void visit(uvec4 particle, vec4 companion) {
  vec3 q = (here - uintBitsToFloat(particle.xyz)) * inverseSupport;
  float t = max(1.0 - sqrt(dot(q, q)), 0.0), weight = t * t * t;
  exchange += weight * (companion - own);
#ifdef ROWS
  row += weight;
#endif
}
void reflectSums(vec3 signs) {}
#define IMAGES
#include "fluid/gather.glsl"

vec4 diffusionRates() { return vec4(params.diffusionRate0, params.diffusionRate1, params.diffusionRate2, params.diffusionRate3); }
#endif
