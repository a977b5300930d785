// Floats as whole numbers of the same order, for atomic minima and maxima.
#ifndef RILL_ORDERED_FLOATS_GLSL
#define RILL_ORDERED_FLOATS_GLSL

uvec3 ordered(vec3 x) {
  uvec3 bits = floatBitsToUint(x);
  return mix(bits | 0x80000000u, ~bits, notEqual(bits & 0x80000000u, uvec3(0u)));
}
vec3 fromOrdered(uvec3 bits) { return uintBitsToFloat(mix(~bits, bits & 0x7fffffffu, notEqual(bits & 0x80000000u, uvec3(0u)))); }

#endif
