#version 460
// Vorticity confinement (Fedkiw, Stam and Jensen 2001; Macklin and Mueller 2013, equation 16): an
// acceleration eps h |curl v| (N x curl v), N along the gradient of the curl's length. Gathers
// positions and curls.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/kernel.glsl"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, curl)
layout(std430, binding = 9) buffer VelocityBlock { vec4 velocity[]; };

#define COMPANION(j) curlAt(j)

vec3 here;
vec4 own;
uint head, fluid;
vec3 rise = vec3(0.0);

void visit(uvec4 particle, vec4 companion) {
  vec3 r = here - uintBitsToFloat(particle.xyz);
  rise += (companion.w - own.w) * gradientShape(sqrt(dot(r, r))) * r;
}
#include "fluid/gather.glsl"

void main() {
  uint i;
  if (!gather(i) || sleeps(head)) return;
  rise *= params.gradientScale;
  // Below a thousandth of the spin a smoothing length its change is noise.
  vec3 direction = rise / (length(rise) + 0.001 * own.w * params.inverseSupport + 1.0e-20);
  vec4 v = velocity[i];
  v.xyz += control.step * params.vorticity * params.support * own.w * cross(direction, own.xyz);
  velocity[i] = v;
}
