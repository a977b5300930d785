#version 460
// The prediction (w: m that solids pushed it out) of an advance's first substep, whose step was not known when the last one ended: x* = x + dt (v + dt (g + push)).
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(std430, binding = 6) readonly buffer SolidBlock { SolidRecord solids[]; };
#include "fluid/outside.glsl"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) readonly buffer PositionBlock { vec4 position[]; };
layout(std430, binding = 3) readonly buffer VelocityBlock { vec4 velocity[]; };
layout(std430, binding = 4) readonly buffer PushBlock { vec4 pushAway[]; };
layout(std430, binding = 5) writeonly buffer PredictionBlock { vec4 prediction[]; };

void main() {
  uint i = flatInvocation();
  if (i >= params.count) return;
  vec3 x = position[i].xyz;
  vec3 next = predicted(x, velocity[i].xyz, pushAway[i].xyz);
  float pushed;
  next = outside(next, ahead(), pushed);
  prediction[i] = vec4(isFinite(next) ? next : x, pushed);
}
