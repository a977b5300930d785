// When a fluid at rest takes no substeps, and what wakes it: docs/notes/sleep.md. Needs `params`, `sums`,
// `gravityChanges` and a `control` to write.
#ifndef RILL_SLEEP_GLSL
#define RILL_SLEEP_GLSL
#include "fluid/rest_limits.glsl"
#include "fluid/time.glsl"
#include "shared/region_records.h"

const float kRestBodies = 2.0;         // times the limit of the root mean square: the fastest body
const float kRestPressure = 0.5;       // share of the mean compression by which that of a substep may differ

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
  float compression = error / (control.step * control.step);
  bool steady = params.tolerance <= 0.0 || abs(compression - control.errorRate) <= kRestPressure * control.errorRate;
  bool slow = meanMotionLeft() <= limits.speed * limits.speed && sums.fast == 0u && control.bodySpeed <= kRestBodies * limits.speed;
  bool still = movingParticles() == 0u || (slow && steady);  // else there is nothing to be steady
  bool rests = still && !melts() && !gravityChanged && quietTime() > 0.0;
  control.restShare = rests ? control.restShare + control.step / limits.time : 0.0;
}

// Whether it is time to look which regions rest: at least as often as a fall through a spacing takes.
bool regionsAreDue() {
  bool late = control.regionTime > params.spacing * inversesqrt(params.layerHead);
  return params.regionsX != 0u && (late || control.wakesAll != 0u || control.regionsDue != 0u);
}

// Regions are looked at when something begins to act.
void noticeCauses() {
  uint acts = uint(quietTime() <= 0.0);
  if (acts > control.acts) control.regionsDue = max(control.regionsDue, kRegionsDue);
  control.acts = acts;
}

void wake() {
  if (control.sleep != kAwake) control.regionsDue = kRegionsDueAfterRest;
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
