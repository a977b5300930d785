// Springs of the host that pull bodies: damped, implicit in time, so that any rate is stable at any step. Needs the storage array `pulls`.
#ifndef RILL_PULLS_GLSL
#define RILL_PULLS_GLSL
#include "fluid/bodies.glsl"

// The solution x of a x = b; `a` is symmetric and positive definite, of which the lower triangle is read.
vec3 solveSymmetric(mat3 a, vec3 b) {
  const float kLeast = 1.0e-7;  // of a pivot; below it is rounding
  float l10 = a[0][1] / a[0][0], l20 = a[0][2] / a[0][0];
  float d1 = max(a[1][1] - l10 * a[0][1], kLeast * a[1][1]);
  float l21 = (a[1][2] - l20 * a[0][1]) / d1;
  float d2 = max(a[2][2] - l20 * a[0][2] - l21 * l21 * d1, kLeast * a[2][2]);
  float y1 = b.y - l10 * b.x, y2 = b.z - l20 * b.x - l21 * y1;
  float z = y2 / d2, y = y1 / d1 - l21 * z;
  return vec3(b.x / a[0][0] - l10 * y - l20 * z, y, z);
}

// The impulse of a spring in a step over the body's mass, m/s: j = -h (w^2 (C + h u) + 2 z w u), where C is the offset from the target,
// u = v + m K j the velocity of the point after it, and K the mobility of the point. `r`: from the center of mass to the point.
vec3 pullOf(PullRecord pull, BodyRecord b, mat3 inverseInertia, vec3 offset, vec3 r, vec3 v, float dt) {
  float a = dt * pull.rate, softness = a * (2.0 * pull.dampingRatio + a), scale = 1.0 / (1.0 + softness);
  vec3 free = freeAxes(b.locked);
  mat3 system;
  for (int i = 0; i < 3; ++i) {
    vec3 axis = vec3(i == 0, i == 1, i == 2);
    vec3 moved = free * axis + b.mass * cross(inverseInertia * cross(r, axis), r);
    system[i] = scale * axis + softness * scale * moved;
  }
  vec3 j = solveSymmetric(system, -scale * (a * pull.rate * offset + softness * v));
  float most = dt * pull.maxForce / b.mass, size = length(j);
  return size > most ? most / size * j : j;
}

// What the pulls of a body add to its velocity and its angular momentum in a substep of `dt`, one after another. `q`: its rotation.
void addPulls(uint body, BodyRecord b, vec4 q, mat3 inverseInertia, float dt, inout vec3 velocity, inout vec3 momentum) {
  for (uint k = 0u; k < min(control.pulls, kMaxPulls); ++k) {
    PullRecord pull = pulls[k];
    if (pull.body != body) continue;
    vec3 r = rotate(q, vec3(pull.pointX, pull.pointY, pull.pointZ));
    vec3 offset = centerOf(b.state) + r - vec3(pull.targetX, pull.targetY, pull.targetZ);
    vec3 j = pullOf(pull, b, inverseInertia, offset, r, velocity + cross(inverseInertia * momentum, r), dt);
    velocity += freeAxes(b.locked) * j;
    momentum += cross(r, b.mass * j);
  }
}
#endif
