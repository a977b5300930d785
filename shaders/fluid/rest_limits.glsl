// What is at rest: docs/notes/sleep.md. Needs `params`, `sums` and `control`.
#ifndef RILL_REST_LIMITS_GLSL
#define RILL_REST_LIMITS_GLSL
#include "fluid/stability.glsl"

const float kRestSpeed = 0.005;        // of the speed of a fall through a spacing, root mean square
const float kRestDisplacement = 0.05;  // spacings that the slowest motion may still go
const float kRestTimes = 20.0;         // times of a fall through a spacing, at least

// What is at rest: speeds up to `speed` (m/s, root mean square), for `time` (s).
struct RestLimits {
  float speed, time;
};

// From the slowest motion that the fluid can have: its longest wave, and how viscosity lets it sink. See docs/notes/sleep.md.
RestLimits restLimits() {
  float gravity = params.layerHead / params.spacing, head;
  FluidSums s = sums;
  head = columnHead(s);
  float height = max((head > 0.0 ? head : control.head) / gravity, params.spacing);
  float waveNumber = 3.14159265 / params.sleepLength, layers = waveNumber * height;
  float wave = inversesqrt(gravity * waveNumber * layers / (1.0 + layers));  // s/rad
  float viscous = 2.0 * params.kinematicViscosity * waveNumber / gravity * max(1.0, 1.5 / (layers * layers * layers));
  return RestLimits(min(kRestSpeed * sqrt(params.layerHead), kRestDisplacement * params.spacing / max(wave, viscous)),
                    max(kRestTimes * params.spacing * inversesqrt(params.layerHead), 3.14159265 * wave));
}

// Whether the density's scale still changes.
bool melts() { return params.inverseMeltingTime * control.timeHigh < 1.0 && params.inverseMeltingTime > 0.0; }
#endif
