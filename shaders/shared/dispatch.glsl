// The invocation's place in a dispatch that may be folded into two dimensions.
#ifndef RILL_DISPATCH_GLSL
#define RILL_DISPATCH_GLSL
uint flatGroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint flatInvocation() { return flatGroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
#endif
