// Shared by begin.comp and control.comp: simulated time and the gravity schedule.
#ifndef RILL_TIME_GLSL
#define RILL_TIME_GLSL
// Adds to the two-float sum (Knuth's TwoSum).
void addTime(inout FluidControl c, float step) {
  precise float sum = c.timeHigh + (step + c.timeLow);
  precise float rest = (c.timeHigh - sum) + (step + c.timeLow);
  c.timeHigh = sum;
  c.timeLow = rest;
}

// Gravity from the last schedule entry up to the present time; entry 0 is the scene's own, at time 0.
void gravityAt(inout FluidControl c) {
  for (uint n = 0u; n < params.gravityChanges && c.gravityIndex < params.gravityChanges; ++n) {
    vec4 change = gravityChanges[c.gravityIndex];
    if (change.w > c.timeHigh + 1.0e-7) break;
    c.gravityX = change.x;
    c.gravityY = change.y;
    c.gravityZ = change.z;
    c.gravityIndex += 1u;
  }
}
#endif
