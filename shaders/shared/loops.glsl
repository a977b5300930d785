// Loops that lanes leave after different numbers of steps:
//   LOOP_WHILE (more) {
//     ...
//     ++k;
//   } LOOP_END(more);
// is while (more) { ... }. The condition is written twice, the same both times. The step stands in
// the body, at its end, so that `continue` would skip it: there is none. With TEXEL (the kernels
// that lavapipe runs) such a loop is tested at its end, since lavapipe goes through the body of one
// that is tested at its top once more when no lane is left. Without it (what SwiftShader runs, see
// gpu/texel_reads.hpp) it is tested at its top: SwiftShader makes mistakes in some of those that
// are not. See ARCHITECTURE.md, "What lavapipe taught".
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
