// What of its own pressure a particle does not feel: see engine/sph/background_pressure.hpp.
#ifndef RILL_BACKGROUND_PRESSURE_GLSL
#define RILL_BACKGROUND_PRESSURE_GLSL
#include "shared/background_pressure.h"

// Coherence: the share 0 .. 1 of a particle's motion that is flow, by the mean velocity of its neighbors and its own difference from that;
// none under few layers.
float coherenceOf(vec3 mean, vec3 difference, float layers) {
  float flow = dot(mean, mean);
  float noise = kCoherentSpeed * kCoherentSpeed * params.layerHead + kCoherentNoise * kCoherentNoise * dot(difference, difference);
  return smoothstep(kShallow, kDeep, layers) * flow / max(flow + noise, 1.0e-30);
}

// Where to read particle i's; the first, if the array may be missing.
uint coherencePlace(uint i) { return control.coherenceKnown != 0u ? i : 0u; }

// The share of `gradient` (1/m), of the density by position of a particle that moves at `velocity` (m/s), that its own multiplier is not
// multiplied by. `displaced`: beside solids, the gradient of what they (and mouths, where these are near, too) displace; else 0.
// `coherence`: of velocity_noise.comp in this block, see coherencePlace().
vec3 backgroundGradient(vec3 gradient, vec3 displaced, vec3 velocity, float coherence) {
  float moves = dot(velocity, velocity);
  float slow = kBackgroundSpeed * kBackgroundSpeed * params.spacing * length(gravity());
  if (control.phase != kPhaseAdvancing || slow < 1.0e-30) return vec3(0.0);  // no gravity; less may be flushed to 0
  float enough = clamp((params.support / params.spacing - kTooFewNeighbors) / (kEnoughNeighbors - kTooFewNeighbors), 0.0, 1.0);
  float least = kMinDisplaced / params.spacing;
  vec3 along = gradient - dot(gradient, displaced) / (dot(displaced, displaced) + least * least) * displaced;
  float uneven = smoothstep(kEvenSupport, kUnevenSupport, sqrt(dot(along, along)) * params.spacing);
  float flows = max(moves / (moves + slow), control.coherenceKnown != 0u ? coherence : 0.0);
  return kBackgroundShare * enough * flows * (1.0 - uneven) * along;
}
#endif
