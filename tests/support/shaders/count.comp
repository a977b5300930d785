// Each workgroup adds its size to one shared counter.
#version 460
layout(local_size_x = 64) in;
layout(binding = 0) buffer Counter { uint counter; };
void main() { if (gl_LocalInvocationID.x == 0) atomicAdd(counter, gl_WorkGroupSize.x); }
