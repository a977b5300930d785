#version 460
// One more Jacobi iteration: moves the prediction by the last multipliers. Gathers from `work`.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/arrays.glsl"
#include "fluid/kernel.glsl"
layout(local_size_x = kFluidGroup) in;
layout(constant_id = 2) const uint NEAR = 0;
layout(constant_id = 3) const uint TENSILE = 0;

layout(push_constant) uniform Push { ChunkPush push; };
layout(std430, binding = 8) buffer PredictionBlock { vec4 prediction[]; };
layout(std430, binding = 9) readonly buffer NearBlock { vec4 nearSample[]; };

vec4 here;
float own;
vec3 moved = vec3(0.0);

float unit = params.inverseRestGradient / kMultiplierScale;  // m^2, of the multipliers
float tensile = params.tensile * control.step * control.step / unit;
float tensileScale = params.valueScale * params.tensileInverse;
float tensilePower = params.tensilePower;

float multiplier(vec4 particle) { return unpackHalf2x16(floatBitsToUint(particle.w)).x; }

void visit(uint j, vec4 particle) {
  vec3 r = here.xyz - particle.xyz;
  float distance = sqrt(dot(r, r));
  float both = own + multiplier(particle);
  if (TENSILE != 0u) {
    both -= tensile * pow(kernelShape(distance) * tensileScale, tensilePower);
  }
  moved += both * gradientShape(distance) * r;
}
#include "fluid/neighbours.glsl"

void main() {
  uint local = flatInvocation();
  uint i = push.first + local;
  if (i >= push.last) return;
  here = PARTICLE(i);
  own = multiplier(here);
  visitNeighbours(i, local);
  moved *= unit * params.gradientScale;
  if (NEAR != 0u) moved += unit * own * nearSample[i].xyz;
  prediction[i] = vec4(insideWalls(here.xyz + moved), prediction[i].w);
}
