// Stages of a step of diffusion: explicit steps, in each of which concentrations become means of those around, so that they stay between 0
// and 1. Shared by C++ and GLSL. See docs/notes/diffusion.md.
#ifndef RILL_SHADERS_SHARED_DIFFUSION_STEPS_H
#define RILL_SHADERS_SHARED_DIFFUSION_STEPS_H

#ifdef __cplusplus
#include <cstdint>
#define RILL_STEPS_REAL double
#define RILL_STEPS_UINT std::uint32_t
#define RILL_STEPS_FUNCTION inline
namespace rill::shared {
#else
#define RILL_STEPS_REAL float
#define RILL_STEPS_UINT uint
#define RILL_STEPS_FUNCTION
#endif

/// As few stages as a step needs that is `length` times the longest explicit one: 1, or an even number, so that the last one writes where
/// the first one read. At most `maxStages`, likewise 1 or even.
RILL_STEPS_FUNCTION RILL_STEPS_UINT diffusionStages(RILL_STEPS_REAL length, RILL_STEPS_UINT maxStages) {
  RILL_STEPS_UINT stages = 1u;
  while (stages < maxStages && !(length <= RILL_STEPS_REAL(stages))) stages += stages == 1u ? 1u : 2u;
  return stages;
}

#ifdef __cplusplus
}  // namespace rill::shared
#endif
#undef RILL_STEPS_REAL
#undef RILL_STEPS_UINT
#undef RILL_STEPS_FUNCTION
#endif
