// Loops with divergent iteration counts:
//   LOOP_WHILE (more) {
//     ...
//     ++k;
//   } LOOP_END(more);
// means while (more) { ... }. Both conditions must be equal. The increment is the last statement of the
// body, so `continue` must not be used. With TEXEL (lavapipe) the loop is tested at its end, because lavapipe
// runs a loop tested at its top once more with no active lane. Without it the loop is tested at its top,
// because SwiftShader miscompiles some do-while loops (docs/notes/lavapipe.md).
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
