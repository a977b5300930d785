#version 460
// The prediction (w: m that solids pushed it out) of an advance's first substep, whose step was not
// known when the last one ended: x* = x + dt (v + dt (g + push)).
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#define WARM_CONSTANT 0
#include "fluid/warm_start.glsl"
#include "shared/arrays.glsl"
layout(std430, binding = 6) readonly buffer SolidBlock { SolidRecord solids[]; };
#include "fluid/outside.glsl"
layout(local_size_x = kFluidGroup) in;
READ_FLOAT4(2, position)
READ_FLOAT4(3, velocity)
READ_FLOAT4(4, warmAcceleration)
layout(std430, binding = 5) writeonly buffer PredictionBlock { vec4 prediction[]; };

void main() {
  uint i = flatInvocation();
  if (i >= params.count) return;
  vec3 x = positionAt(i).xyz;
  vec3 next = predicted(x, velocityAt(i).xyz, KEPT_WARM_ACCELERATION(warmAccelerationAt(i)));
  float pushed;
  next = outside(next, ahead(), pushed);
  prediction[i] = vec4(isFinite(next) ? next : x, pushed);
}
