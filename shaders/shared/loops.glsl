// LOOP_WHILE (more) { ... } LOOP_END(more); is while (more) { ... }, for loops that lanes leave after different numbers of steps. No `continue` in them.
// Lavapipe goes through the body of a loop that is left at its top once more, for nobody. SwiftShader loses values behind one that is left at its end; it runs the
// variants without TEXEL (gpu/texel_reads.hpp).
#ifndef RILL_LOOPS_GLSL
#define RILL_LOOPS_GLSL
#ifdef TEXEL
#define LOOP_WHILE(more) if (more) do
#define LOOP_END(more) while (more)
#else
#define LOOP_WHILE(more) while (more)
#define LOOP_END(more)
#endif
#endif
