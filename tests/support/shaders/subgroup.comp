// Writes the subgroup size and the specialization constants.
#version 460
#extension GL_KHR_shader_subgroup_basic : require
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint number = 1;
layout(constant_id = 1) const float factor = 1;
layout(binding = 0) writeonly buffer Target { uint target[]; };
void main() {
  if (gl_LocalInvocationID.x == 0) { target[0] = gl_SubgroupSize; target[1] = number; target[2] = uint(factor * 4); }
}
