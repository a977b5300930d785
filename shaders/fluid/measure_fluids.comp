#version 460
// Figures of each of several fluids: how many particles it has, and their compression.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/fluids.glsl"
#include "shared/arrays.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, position)
READ_FLOAT4(3, velocity)  // w: density over rest density
layout(std430, binding = 4) buffer FluidFigureBlock { FluidFigureRecord fluidFigures[]; };

void main() {
  uint i = flatInvocation();
  if (i >= control.count) return;
  vec4 particle = positionAt(i);
  uint fluid = fluidOfPosition(particle);
  if (!isActive(particle.xyz)) {
    atomicAdd(fluidFigures[fluid].inactive, 1u);
    return;
  }
  float error = clamp(velocityAt(i).w - 1.0, 0.0, kMaxFigureError);
  uint add = uint(error / kErrorUnit + 0.5), old = atomicAdd(fluidFigures[fluid].errorLow, add);
  if (old + add < old) atomicAdd(fluidFigures[fluid].errorHigh, 1u);
  atomicMax(fluidFigures[fluid].errorMax, floatBitsToUint(error));
  atomicAdd(fluidFigures[fluid].particles, 1u);
}
