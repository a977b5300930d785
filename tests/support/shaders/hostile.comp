// What a driver does where the specification lets it choose: see gpu/hostile_driver_test.cpp. Read from a buffer, so that no compiler
// knows the numbers.
#version 460
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Source { float one, denormal, halves[2]; uint half_; float nan, infinite, factors[8]; };
layout(binding = 1) buffer Target {
  uint flushed, bits, packed, unpacked, ordered, found_nan, found_infinity, lowest, shuffled, next;
  uint products[8], quotients[8], turn[64];
};
void main() {
  uint received = 0u;
  if ((gl_SubgroupInvocationID & 1u) == 1u) received = subgroupShuffle(7u, gl_SubgroupInvocationID - 1u);  // that lane is not here
  if (gl_LocalInvocationID.x == 1u && gl_WorkGroupID.x == 0u) shuffled = received;
  if (gl_LocalInvocationID.x != 0u) return;
  turn[gl_WorkGroupID.x] = atomicAdd(next, 1u);
  if (gl_WorkGroupID.x != 0u) return;
  flushed = floatBitsToUint(denormal * one);
  bits = floatBitsToUint(denormal);
  packed = packHalf2x16(vec2(halves[0], halves[1]));
  unpacked = floatBitsToUint(unpackHalf2x16(half_).x);
  ordered = uint(nan < one);
  found_nan = uint(isnan(nan));
  lowest = floatBitsToUint(min(one, nan));
  found_infinity = uint(infinite == uintBitsToFloat(0x7F800000u));
#define PRODUCT(k) products[k] = floatBitsToUint(factors[k] * factors[(k + 1) & 7]);  // an instruction each
#define QUOTIENT(k) quotients[k] = floatBitsToUint(factors[k] / factors[(k + 1) & 7]);
  QUOTIENT(0) QUOTIENT(1) QUOTIENT(2) QUOTIENT(3) QUOTIENT(4) QUOTIENT(5) QUOTIENT(6) QUOTIENT(7)
  PRODUCT(0) PRODUCT(1) PRODUCT(2) PRODUCT(3) PRODUCT(4) PRODUCT(5) PRODUCT(6) PRODUCT(7)
}
