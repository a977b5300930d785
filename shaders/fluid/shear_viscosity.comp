#version 460
// The viscosity of each particle for the substep, from the rate of shear before it, and the velocities that it is from. See
// docs/notes/viscosity.md. A linear flow has the same rate whichever half of the neighbors is missing.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "fluid/uniforms.glsl"
#define PARTICLE uvec4
#include "fluid/arrays.glsl"
#include "fluid/cluster.glsl"
#include "fluid/fluids.glsl"
#include "fluid/solid_samples.glsl"
#include "shared/shear_viscosity.h"
layout(local_size_x = kFluidGroup) in;
layout(push_constant) uniform Push { ChunkPush push; };
READ_FLOAT4(8, velocity)
READ_NEAR_DISPLACED(10)
layout(std430, binding = 9) writeonly buffer PriorBlock { vec4 priorVelocity[]; };
#define COMPANION(j) velocityAt(j)

float inverseSupport = params.inverseSupport;  // loaded once, see kernel.glsl
vec3 here;
vec4 own;
uint head, fluid;
// Of pairs of one fluid, with the weight w of viscous_force.glsl:
float squares = 0.0, moment = 0.0;             // sums of w (q . (v_j - v_i))^2 and w q^4
vec3 diagonal = vec3(0.0), mixed = vec3(0.0);  // of w q q^T; mixed: yz, zx, xy
mat3 slopes = mat3(0.0);                       // of w (v_j - v_i) q^T
float around = 0.0;                            // sum of w q^4 over all fluids that have a viscosity

uint fluidsWithViscosity() {
  uint all = 0u;
  for (uint k = 0u; k < (FLUIDS ? 8u : 1u); ++k) all |= rheologyOf(k).x + rheologyOf(k).y > 0.0 ? 1u << k : 0u;
  return all;
}
uint viscous = fluidsWithViscosity();

void visit(uvec4 particle, vec4 companion) {
  vec3 q = (here - uintBitsToFloat(particle.xyz)) * inverseSupport;
  float square = dot(q, q), t = max(1.0 - sqrt(square), 0.0), weight = t * t * t;
  uint other = fluidOfWork(particle);
  if ((viscous >> other & 1u) != 0u) around += weight * square * square;
  if (other != fluid) weight = 0.0;
  vec3 difference = companion.xyz - own.xyz;
  float along = dot(q, difference);
  squares += weight * along * along;
  moment += weight * square * square;
  diagonal += weight * q * q;
  mixed += weight * q.yzx * q.zxy;
  slopes += outerProduct(weight * difference, q);
}

void reflectSums(vec3 signs) {
  vec3 image = NO_SLIP_WALLS ? signs.x * signs.y * signs.z * signs : signs;
  own.xyz *= image;
  mixed *= signs.yzx * signs.zxy;
  slopes = mat3(signs.x * image * slopes[0], signs.y * image * slopes[1], signs.z * image * slopes[2]);
}
#define IMAGES
#include "fluid/gather.glsl"

// sqrt(2 D : D) of the linear flow that fits, without its divergence. Noise of the particles' velocities hardly changes it.
float fittedRate() {
  float ridge = max(1.0e-3 * (diagonal.x + diagonal.y + diagonal.z), 1.0e-9);
  vec3 d = diagonal + ridge;
  mat3 flow = slopes * inverse(mat3(d.x, mixed.z, mixed.y, mixed.z, d.y, mixed.x, mixed.y, mixed.x, d.z));
  float divergence = (flow[0].x + flow[1].y + flow[2].z) / 3.0;
  vec3 along = vec3(flow[0].x, flow[1].y, flow[2].z) - divergence;
  vec3 across = vec3(flow[1].z + flow[2].y, flow[2].x + flow[0].z, flow[0].y + flow[1].x);
  return inverseSupport * sqrt(2.0 * dot(along, along) + dot(across, across));
}

// The same from the pairs' own rates, which vanishes in rigid motion whatever the neighbors are.
float rateOfPairs() { return inverseSupport * sqrt(15.0 * squares / max(moment, 1.0e-20)); }

void main() {
  uint i;
  if (!gather(i)) return;
  vec3 rheology = rheologyOf(fluid);
  float rate = clamp(min(fittedRate(), kShearOfPairs * rateOfPairs()), kMinShearRate, kMaxShearRate);
  float viscosity = rheology.x / rate + rheology.y * pow(rate, rheology.z);
  // At a surface, and in a liquid, sums are less than in the lattice. Solids count with the density that they displace.
  float whole = around + (SOLIDS || MOUTHS ? params.shearMoment * displacedAt(i, head).w : 0.0);
  bool changes = rheology.x > 0.0 || rheology.z != 0.0;
  if (changes && whole > 0.0) viscosity *= clamp(params.shearMoment / max(whole, 1.0e-20), 1.0, kShearGain);
  vec3 rows = diagonal + abs(mixed.zxy) + abs(mixed.yzx);
  float row = 2.0 * inverseMassOf(fluid) * params.viscosityRate * control.step * max(rows.x, max(rows.y, rows.z));
  float room = (params.shearBound - 1.0) / kShearMargin;
  bool capped = row * viscosity > room;
  if (capped) atomicAdd(sums.viscosityCapped, 1u);
  priorVelocity[i] = vec4(own.xyz, capped ? room / row : viscosity);
  if (i == 0u) priorVelocity[params.capacity] = vec4(0.0);  // the dummy neighbor
}
