// Writes a constant plus a value from a buffer, indexed by the fragment's x.
#version 460
layout(push_constant) uniform Push { vec4 rect; float depth; float value; };
layout(std430, set = 0, binding = 0) readonly buffer Added { float added[]; };
layout(location = 0) out float color;
void main() { color = value + added[uint(gl_FragCoord.x)]; }
