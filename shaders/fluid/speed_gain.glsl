// Bounds on what separating particles and solids adds to speeds: docs/notes/overlaps.md.
#ifndef RILL_SPEED_GAIN_GLSL
#define RILL_SPEED_GAIN_GLSL

// What a correction may add to a speed in a substep, m/s.
float maxSpeedGain() {
  return clamp(max(0.5 * control.speed, 5.0 * control.bodySpeed), params.minSpeedGain, params.maxSpeedGain) +
         4.0 * control.step * sqrt(dot(gravity(), gravity()));
}

// The part of what solids push a particle by (m/s) that changes its velocity: what stops their approach, and a correction's bound more.
float keptPush(vec3 velocity, vec3 push) {
  float speed = length(push);
  if (speed <= 0.0) return 1.0;
  float approach = max(-dot(velocity, push) / speed, 0.0) + control.solidSpeed;
  return min(1.0, (approach + maxSpeedGain()) / speed);
}
#endif
