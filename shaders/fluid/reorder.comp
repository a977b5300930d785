#version 460
// Gathers the particles into the order of their cells. build.comp copies them back.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) readonly buffer OrderBlock { uint order[]; };
layout(std430, binding = 3) readonly buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 4) readonly buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 5) readonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 6) readonly buffer WarmBlock { float warm[]; };
layout(std430, binding = 7) readonly buffer IdBlock { uint id[]; };
layout(std430, binding = 8) writeonly buffer SortedPositionBlock { vec4 sortedPosition[]; };
layout(std430, binding = 9) writeonly buffer SortedPredictionBlock { vec4 sortedPrediction[]; };
layout(std430, binding = 10) writeonly buffer SortedVelocityBlock { vec4 sortedVelocity[]; };
layout(std430, binding = 11) writeonly buffer SortedScalarBlock { uvec2 sortedScalar[]; };  // warm, id

void main() {
  uint i = flatInvocation();
  if (i >= params.count) return;
  uint from = order[i];
  sortedPosition[i] = position[from];
  sortedPrediction[i] = prediction[from];
  sortedVelocity[i] = velocity[from];
  sortedScalar[i] = uvec2(floatBitsToUint(warm[from]), id[from]);
}
