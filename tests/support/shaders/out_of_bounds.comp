// Reads where the buffer's own first number says, for the test that validation notices a read out of bounds.
#version 460
layout(local_size_x = 1) in;
layout(binding = 0) readonly buffer Source { uint number[]; };
layout(binding = 1) writeonly buffer Target { uint found[]; };
void main() { found[0] = number[number[0]]; }
