// Poses between keyframes. Needs the storage array `keyframes` of KeyframeRecord.
#ifndef RILL_KEYFRAMES_GLSL
#define RILL_KEYFRAMES_GLSL
#include "shared/pose.glsl"

// Sine and cosine up to half pi: Vulkan promises no more than 2^-11 for its own. The next terms are below 1e-7.
vec2 sineAndCosine(float x) {
  float s = x * x;
  float sine = x * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362880.0 - s / 39916800.0)))));
  float cosine = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s * (1.0 / 40320.0 + s * (-1.0 / 3628800.0 + s / 479001600.0)))));
  return vec2(sine, cosine);
}

// A rotation after `seconds` at an angular velocity, up to half a turn.
vec4 turnedFor(vec4 q, vec3 angular, float seconds) {
  float speed = length(angular);
  if (!(speed > 0.0)) return q;
  vec2 turn = sineAndCosine(0.5 * speed * seconds);
  return normalize(composed(vec4(angular * (turn.x / speed), turn.y), q));
}

// The pose at a time (s) of a solid that starts at `base`: linear and spherical linear between keyframes, held outside.
PoseRecord keyframedPose(PoseRecord base, uint first, uint count, float time) {
  if (count == 0u) return base;
  uint low = 0u, high = count;  // the first keyframe later than `time` is in low .. high
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (keyframes[first + middle].at <= time) low = middle + 1u; else high = middle;
  }
  KeyframeRecord a = keyframes[first + max(low, 1u) - 1u];
  vec3 moved = vec3(a.x, a.y, a.z), velocity = vec3(0.0), angular = vec3(0.0);
  vec4 turned = vec4(a.rotationX, a.rotationY, a.rotationZ, a.rotationW);
  if (low > 0u && low < count) {
    KeyframeRecord b = keyframes[first + low];
    float span = b.at - a.at, since = time - a.at;
    velocity = (vec3(b.x, b.y, b.z) - moved) / span;
    moved += velocity * since;
    angular = vec3(a.turnX, a.turnY, a.turnZ) / span;
    turned = turnedFor(turned, angular, since);
  }
  return poseOf(centerOf(base) + moved, composed(turned, rotationOf(base)), velocity, angular);
}
#endif
