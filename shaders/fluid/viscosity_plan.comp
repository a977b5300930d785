#version 460
// The number of steps that viscosity takes in this substep, from the bound of its eigenvalues. One invocation.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/viscosity_steps.h"
layout(local_size_x = 1) in;
layout(std430, binding = 2) buffer SumsBlock { FluidSums sums; };

void main() {
  float bound = uintBitsToFloat(sums.viscosityBound), reached = SHEAR_VISCOSITY ? min(bound, params.shearBound) : bound;
  ViscositySteps steps = viscositySteps(reached, params.viscositySteps);
  sums.viscositySteps = steps.count;
  sums.viscosityCenter = steps.center;
  sums.viscosityHalfWidth = steps.halfWidth;
  sums.viscosityDecay = steps.decay;
  if (steps.remaining > kViscosityRemaining || bound > reached) sums.viscosityBoundHits += 1u;
}
