// Which particles are active. Inactive ones, and the dummy neighbor that pads the lists, lie at kInactivePosition. All of this compares
// bits, because a device may assume that no operand is NaN or infinite.
#ifndef RILL_ACTIVE_GLSL
#define RILL_ACTIVE_GLSL
#include "shared/fluid_records.h"

// All components below `limit`, which is above 0, in magnitude; not NaN.
bool isWithin(vec3 x, float limit) { return all(lessThan(floatBitsToUint(x) & 0x7FFFFFFFu, uvec3(floatBitsToUint(limit)))); }

// A NaN counts as active.
bool isActive(vec3 x) {
  const uint bits = floatBitsToUint(x.x), first = floatBitsToUint(kInactiveLimit), infinite = 0x7F800000u;
  return bits - first > infinite - first;
}

// Active and finite.
bool drawable(vec3 x) { return isWithin(x, kInactiveLimit); }
#endif
