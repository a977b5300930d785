#version 460
// The number of stages that diffusion takes, and the time that each is for. One invocation.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/diffusion_steps.h"
layout(local_size_x = 1) in;
layout(std430, binding = 2) buffer SumsBlock { FluidSums sums; };

void main() {
  // In the longest explicit step the particle with the most neighbors takes their mean.
  float length = control.diffusion * params.maxDiffusionRate * uintBitsToFloat(sums.diffusionRow);
  uint stages = diffusionStages(length, params.diffusionStages);
  sums.diffusionStages = stages;
  sums.diffusionStep = control.diffusion * min(1.0 / max(length, 1.0e-20), 1.0 / float(stages));
  if (length > float(stages)) sums.diffusionBoundHits += 1u;
}
