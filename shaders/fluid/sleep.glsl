// When a fluid at rest takes no substeps, and what wakes it: docs/notes/sleep.md. Needs `params`, `sums`,
// `gravityChanges` and a `control` to write.
#ifndef RILL_SLEEP_GLSL
#define RILL_SLEEP_GLSL
#include "fluid/stability.glsl"
#include "fluid/time.glsl"

// Of the speed of a fall through a spacing: root mean square, and of the fastest particle.
const float kRestSpeed = 0.005;
const float kRestMaxSpeed = 0.15;
const float kRestBodies = 2.0;         // times the limit of the root mean square: the fastest body
const float kRestDisplacement = 0.05;  // spacings that the slowest motion may still go
const float kRestTimes = 20.0;         // times of a fall through a spacing, at least
const float kRestPressure = 0.5;       // share of the mean compression by which that of a substep may differ

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

// Mean square of the speeds after the last correction, m^2/s^2.
float meanMotion() {
  return (float(sums.motionHigh) * 4294967296.0 + float(sums.motionLow)) * kMotionUnit / float(max(control.count, 1u)) * params.layerHead;
}

// s until something moves that is known beforehand; 0: it does.
float quietTime() {
  float quiet = 3.0e38;
  uint low = 0u, high = params.wakes;  // the first that is not over is in low .. high
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (gravityChanges[params.gravityChanges + middle].y - control.timeHigh > control.timeLow) high = middle; else low = middle + 1u;
  }
  if (low < params.wakes) quiet = (gravityChanges[params.gravityChanges + low].x - control.timeHigh) - control.timeLow;
  if (control.gravityIndex < params.gravityChanges)
    quiet = min(quiet, (gravityChanges[control.gravityIndex].w - control.timeHigh) - control.timeLow);
  return max(quiet, 0.0);
}

// Accounts for the motion after the last substep, and the mean compression of this one's prediction.
void accountRest(float error, bool gravityChanged) {
  if (params.sleeps == 0u) return;
  RestLimits limits = restLimits();
  float fastest = kRestMaxSpeed * sqrt(params.layerHead), compression = error / (control.step * control.step);
  bool melts = params.inverseMeltingTime * control.timeHigh < 1.0 && params.inverseMeltingTime > 0.0;
  bool steady = params.tolerance <= 0.0 || abs(compression - control.errorRate) <= kRestPressure * control.errorRate;
  bool slow = meanMotion() <= limits.speed * limits.speed && control.speed <= fastest && control.bodySpeed <= kRestBodies * limits.speed;
  bool rests = slow && steady && !melts && !gravityChanged && quietTime() > 0.0;
  control.restShare = rests ? control.restShare + control.step / limits.time : 0.0;
}

void wake() {
  control.sleep = kAwake;
  control.restShare = 0.0;
}

// At the begin of an advance: takes its time without substeps, all of it or up to what wakes the fluid.
// `disturbed`: the host moves something.
void sleepThrough(bool disturbed) {
  control.timeAsleep = 0.0;
  if (params.sleeps == 0u || disturbed) wake();
  if (params.sleeps == 0u) return;
  bool asleep = control.sleep != kAwake;
  if (control.timeLeft <= 0.0 || control.nextPhase != kPhaseAdvancing || (!asleep && control.restShare < 1.0)) return;
  float quiet = quietTime();
  if (quiet > control.timeLeft - 0.25 * control.desiredStep && quiet > 0.0) {
    quiet = control.timeLeft;  // what is left may be too short for a substep: see time-step-and-substeps.md on rounding
    if (!asleep) control.executedFallsAsleep += 1u;
    control.sleep = asleep ? kAsleep : kFallingAsleep;
  } else {
    wake();
    if (!asleep) return;
  }
  control.timeAsleep = quiet;
  control.timeLeft -= quiet;
  addTime(quiet);
}
#endif
