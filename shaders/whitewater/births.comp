#version 460
// How many diffuse particles each fluid particle emits: trapped air and breaking crests, where the fluid is fast enough.
#extension GL_GOOGLE_include_directive : require
#include "shared/arrays.glsl"
#include "whitewater/whitewater.glsl"

layout(local_size_x = kWhiteGroup) in;
READ_UINT4(0, place)
READ_FLOAT4(1, motion)
READ_UINT(2, start)
READ_FLOAT4(3, surface)
layout(std430, set = 0, binding = 4) readonly buffer Strain { float strain[]; };
layout(std430, set = 0, binding = 5) writeonly buffer Births { uint births[]; };
layout(std430, set = 0, binding = 6) buffer Counts { uint counts[]; };
#include "whitewater/white_walk.glsl"

vec3 normal;
float bend = 0.0, squares = 0.0;

// Of a ball (n_j - n_i) . (x_j - x_i) is the squared distance over its radius
void visit(uint slot, vec3 to, float square) {
  const vec4 neighbor = surfaceAt(slot);
  const float weight = kernelAt(square) * neighbor.w;
  bend += weight * dot(neighbor.xyz - normal, to);
  squares += weight * dot(to, to);
}

void main() {
  const uint slot = flatInvocation();
  if (slot >= startAt(white.bins)) return;
  const vec3 v = motionAt(slot).xyz;
  const vec4 own = surfaceAt(slot);
  const float energy = clamp((0.5 * dot(v, v) - kWhiteEnergyLow) / (kWhiteEnergyHigh - kWhiteEnergyLow), 0.0, 1.0);
  const float area = white.spacing * white.spacing, volume = area * white.spacing, speed = length(v), rate = strain[slot];
  normal = own.xyz;
  const float outward = dot(v, normal);
  float flow = white.trapping * volume * rate * brokenUp(speed * rate);  // m^3/s
  // Inside of the fluid there is next to no area
  if (energy > 0.0 && own.w > 0.01 && outward > kWhiteCrestCosine * speed) {
    if (!walk(uintBitsToFloat(placeAt(slot).xyz))) atomicAdd(counts[kWhiteBoundHits], 1u);
    const float curvature = clamp(bend / max(squares, 1e-12 * area), 0.0, 1.0 / white.spacing);
    flow += white.breaking * own.w * area * outward * brokenUp(outward * outward * curvature);
  }
  const float expected = min(energy * flow / white.parcel * white.seconds, 2147483648.0 / float(white.capacity));
  const uint wanted = uint(expected + unit(whiteHash(white.seed, slot, counts[kWhiteSteps], kWhiteNone)));
  births[slot] = min(wanted, mostBirths());
  if (wanted > mostBirths()) atomicAdd(counts[kWhiteLost], wanted - mostBirths());
}
