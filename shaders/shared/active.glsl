// Which particles are active. Inactive ones, and the dummy neighbor that pads the lists, lie at kInactivePosition.
#ifndef RILL_ACTIVE_GLSL
#define RILL_ACTIVE_GLSL
#include "shared/fluid_records.h"

// A NaN counts as active.
bool isActive(vec3 x) { return !(x.x >= kInactiveLimit); }

// Active and finite. Compares bits because a compiler may assume that there are no NaNs.
bool drawable(vec3 x) {
  const uvec3 magnitude = floatBitsToUint(x) & 0x7FFFFFFFu;
  return all(lessThan(magnitude, uvec3(floatBitsToUint(kInactiveLimit))));
}
#endif
