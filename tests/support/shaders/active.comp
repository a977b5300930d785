// The functions of active.glsl, applied to numbers that are known at run time only.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/active.glsl"
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer Source { float number[]; };
layout(binding = 1) writeonly buffer Target { uint found[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(number.length())) return;
  vec3 x = vec3(number[i], 0.0, 0.0), y = vec3(0.0, number[i], 0.0);
  found[i] = uint(isActive(x)) | uint(isWithin(y, 5.0)) << 1 | uint(drawable(x)) << 2 | uint(drawable(y)) << 3;
}
