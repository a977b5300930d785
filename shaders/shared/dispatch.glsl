// Dispatches that may be folded into two dimensions.
#ifndef RILL_DISPATCH_GLSL
#define RILL_DISPATCH_GLSL
// Workgroups in x, y and z, none above 65,535, as foldGroups() of engine/sort/dispatches.hpp has them. 0 stays 0.
uvec3 foldGroups(uint groups) {
  if (groups == 0u) return uvec3(0u);
  const uint rows = (groups + 65534u) / 65535u;
  return uvec3((groups + rows - 1u) / rows, rows, 1u);
}
uint divideUp(uint all, uint each) { return (all + each - 1u) / each; }
uint flatGroup() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
// A macro, because in a function before the shader's local_size declaration gl_WorkGroupSize would be 1.
#define flatInvocation() (flatGroup() * gl_WorkGroupSize.x + gl_LocalInvocationID.x)
#endif
