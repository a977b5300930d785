// The invocation's place in a dispatch that may be folded into two dimensions.
#ifndef RILL_DISPATCH_GLSL
#define RILL_DISPATCH_GLSL
uint flatGroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
// A macro: a function that comes before the shader's local_size would be compiled with a gl_WorkGroupSize of 1.
#define flatInvocation() (flatGroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x)
#endif
