// Whether there is a warm start (Fluid's setup.warm). Without one, multipliers and accelerations
// are not kept, and their placeholder bindings are not accessed. Before it includes this the shader
// defines WARM_CONSTANT, the constant's number.
#ifndef RILL_WARM_START_GLSL
#define RILL_WARM_START_GLSL
layout(constant_id = WARM_CONSTANT) const uint WARM = 1;

// The warm-start acceleration, m/s^2, or zero without a warm start.
#define KEPT_WARM_ACCELERATION(push) (WARM != 0u ? (push).xyz : vec3(0.0))
#endif
