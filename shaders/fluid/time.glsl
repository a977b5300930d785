// Simulated time and the gravity schedule. Needs `params`, `gravityChanges` and a `control` to write.
#ifndef RILL_TIME_GLSL
#define RILL_TIME_GLSL
// Adds to the two-float sum (Knuth's TwoSum).
void addTime(float step) {
  precise float sum = control.timeHigh + (step + control.timeLow);
  precise float rest = (control.timeHigh - sum) + (step + control.timeLow);
  control.timeHigh = sum;
  control.timeLow = rest;
}

// Gravity from the last schedule entry up to the present time; entry 0 is the scene's own, at time 0. Returns whether it has changed.
bool gravityAt() {
  vec3 before = vec3(control.gravityX, control.gravityY, control.gravityZ);
  for (uint n = 0u; n < params.gravityChanges && control.gravityIndex < params.gravityChanges; ++n) {
    vec4 change = gravityChanges[control.gravityIndex];
    if (change.w > control.timeHigh + 1.0e-7) break;
    control.gravityX = change.x;
    control.gravityY = change.y;
    control.gravityZ = change.z;
    control.gravityIndex += 1u;
  }
  bool changed = vec3(control.gravityX, control.gravityY, control.gravityZ) != before;
  if (changed) control.wakesAll = 1u;
  return changed;
}
#endif
