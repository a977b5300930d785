// Writes dispatch arguments on the device.
#version 460
layout(local_size_x = 1) in;
layout(binding = 0) writeonly buffer Arguments { uint arguments[]; };
layout(push_constant) uniform Push { uint groups; };
void main() { arguments[0] = groups; arguments[1] = 1; arguments[2] = 1; }
