// What of its own pressure a particle does not feel: see engine/sph/background_pressure.hpp.
#ifndef RILL_BACKGROUND_PRESSURE_GLSL
#define RILL_BACKGROUND_PRESSURE_GLSL
#include "shared/background_pressure.h"

// The share of `gradient` (1/m), of the density by position of a particle that moves at `velocity` (m/s), that its own multiplier is not
// multiplied by. `displaced`: beside solids, the gradient of what they (and mouths, where these are near, too) displace; else 0.
vec3 backgroundGradient(vec3 gradient, vec3 displaced, vec3 velocity) {
  float moves = dot(velocity, velocity);
  float slow = kBackgroundSpeed * kBackgroundSpeed * params.spacing * length(gravity());
  if (control.phase != kPhaseAdvancing || slow < 1.0e-30) return vec3(0.0);  // no gravity; less may be flushed to 0
  float enough = clamp((params.support / params.spacing - kTooFewNeighbors) / (kEnoughNeighbors - kTooFewNeighbors), 0.0, 1.0);
  float least = kMinDisplaced / params.spacing;
  vec3 along = gradient - dot(gradient, displaced) / (dot(displaced, displaced) + least * least) * displaced;
  float uneven = smoothstep(kEvenSupport, kUnevenSupport, sqrt(dot(along, along)) * params.spacing);
  return kBackgroundShare * enough * moves / (moves + slow) * (1.0 - uneven) * along;
}
#endif
