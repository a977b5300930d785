// Linear indices in a dispatch that may be folded into two dimensions.
#ifndef RILL_DISPATCH_GLSL
#define RILL_DISPATCH_GLSL
uint flatGroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
// A macro, because in a function before the shader's local_size declaration gl_WorkGroupSize would be 1.
#define flatInvocation() (flatGroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x)
#endif
