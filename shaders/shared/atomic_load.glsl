// A load of what other invocations change by atomics at the same time: a plain one would be a data race. Needs
// GL_KHR_memory_scope_semantics, in the shader.
#ifndef RILL_ATOMIC_LOAD_GLSL
#define RILL_ATOMIC_LOAD_GLSL
#define ATOMIC_LOAD(x) atomicLoad(x, gl_ScopeDevice, gl_StorageSemanticsNone, gl_SemanticsRelaxed)
#endif
