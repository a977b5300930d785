// dt L of viscosity, negative: sum_j c_ij (1-q)^3 q q^T (v_j - v_i), q from j to i over the support. The force of a pair is
// along its line and proportional to the speed along it: it keeps angular momentum. The pairs are those of the density
// pass: gathers from `work`. Include it after `push` is declared, with COMPANION(j) the velocity of j. BOUNDS: also
// bounds the eigenvalues of 1 + dt L.
#ifndef RILL_FLUID_VISCOUS_FORCE_GLSL
#define RILL_FLUID_VISCOUS_FORCE_GLSL
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"

float inverseSupport = params.inverseSupport;  // loaded once, see kernel.glsl
vec3 here;
vec4 own;
uint head, fluid;
vec3 force = vec3(0.0);
#ifdef BOUNDS
vec3 diagonal = vec3(0.0), mixed = vec3(0.0);  // of sum_j (1-q)^3 q q^T; mixed: yz, zx, xy
#endif

// Where shear changes viscosities, each particle's is w of its companion.
float viscosityWith(uvec4 particle, vec4 companion) {
  return SHEAR_VISCOSITY ? harmonicMean(own.w, companion.w) : pairViscosity(fluid, fluidOfWork(particle));
}

void visit(uvec4 particle, vec4 companion) {
  vec3 q = (here - uintBitsToFloat(particle.xyz)) * inverseSupport;
  float t = max(1.0 - sqrt(dot(q, q)), 0.0), weight = viscosityWith(particle, companion) * t * t * t;
  force += weight * dot(q, companion.xyz - own.xyz) * q;
#ifdef BOUNDS
  diagonal += weight * q * q;
  mixed += weight * q.yzx * q.zxy;
#endif
}

// The velocity of images is as in a mirror; where fluid sticks to walls it is reversed along them instead and kept across
// them, for each wall. In both cases L stays symmetric.
void reflectSums(vec3 signs) {
  vec3 image = NO_SLIP_WALLS ? signs.x * signs.y * signs.z * signs : signs;
  force *= image;
  own.xyz *= image;
#ifdef BOUNDS
  mixed *= signs.yzx * signs.zxy;
#endif
}
#define IMAGES
#include "fluid/gather.glsl"

// Gathers `force` of the invocation's particle i; false where it has none. 0 for one that sleeps.
bool gatherForce(out uint i) {
  bool inRange = gather(i);
  force *= inverseMassOf(fluid) * params.viscosityRate * control.step;
  return inRange;
}

// xyz: the pull of solids that the particle sticks to, w: the coefficient of its velocity. 0 where there are none.
#define HOLD_AT(i) (NO_SLIP_SOLIDS && (head & kNearSolidsBit) != 0u ? hold[i] : vec4(0.0))

#ifdef BOUNDS
// Of the eigenvalues that the particle's row may have: twice a norm of its own block.
float eigenvalueBound() {
  vec3 rows = diagonal + abs(mixed.zxy) + abs(mixed.yzx);
  return 1.0 + 2.0 * inverseMassOf(fluid) * params.viscosityRate * control.step * max(rows.x, max(rows.y, rows.z));
}
#endif
#endif
