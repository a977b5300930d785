// The control block in a pass of one workgroup: a copy that the pass changes, and stores at its end. MERGED (GPUs): the
// invocations have equal copies and share the writing of dispatch commands. Else there is one invocation: a barrier costs CPU
// drivers more than the loop.
#ifndef RILL_CONTROL_COPY_GLSL
#define RILL_CONTROL_COPY_GLSL
#ifdef MERGED
layout(local_size_x = 32) in;
#else
layout(local_size_x = 1) in;
#endif
layout(std430, binding = 1) buffer ControlBlock { FluidControl control; } stored;
FluidControl control;

void storeControl() {
#ifdef MERGED
  barrier();  // all have read it
#endif
  if (gl_LocalInvocationID.x == 0u) stored.control = control;
}
#endif
