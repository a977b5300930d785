// Whether there is a warm start (Fluid's setup.warm). Without one, multipliers and pushes are not kept from substep to substep, and what is bound in their stead is not
// touched. Before it includes this the shader defines WARM_CONSTANT, the constant's number.
#ifndef RILL_WARM_GLSL
#define RILL_WARM_GLSL
layout(constant_id = WARM_CONSTANT) const uint WARM = 1;

// `push`, an element of the array of pushes, or none.
#define KEPT_PUSH(push) (WARM != 0u ? (push).xyz : vec3(0.0))
#endif
