// Bounds on what separating particles and solids adds to speeds: docs/notes/overlaps.md.
#ifndef RILL_SPEED_GAIN_GLSL
#define RILL_SPEED_GAIN_GLSL

// What a correction may add to a speed in a substep, m/s.
float maxSpeedGain() {
  return clamp(max(0.5 * control.speed, 5.0 * control.bodySpeed), params.minSpeedGain, params.maxSpeedGain) +
         4.0 * control.step * sqrt(dot(gravity(), gravity()));
}

// The part of a push by walls, solids or earlier iterations that changes a particle's velocity: what stops its approach, `moved`, and
// `most` more. All in meters, or all in m/s.
float keptPush(vec3 moved, vec3 push, float most) {
  float size = length(push);
  return size > 0.0 ? min(1.0, (max(-dot(moved, push) / size, 0.0) + most) / size) : 1.0;
}
#endif
