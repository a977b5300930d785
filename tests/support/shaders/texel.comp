// target[i] = sum of the components of a texel
#version 460
layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer source;
layout(binding = 1) writeonly buffer Target { float target[]; };
layout(push_constant) uniform Push { uint count; };
void main() {
  const uint i = gl_WorkGroupID.x * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (i < count) target[i] = dot(texelFetch(source, int(i)), vec4(1));
}
