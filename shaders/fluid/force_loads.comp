#version 460
// Loads on solids, and velocities of bodies, from what forces after the solve gave the fluid beside them: it sticks to them, or its
// surface has tension. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/pose.glsl"
#include "shared/body_records.h"
layout(local_size_x = 64) in;
layout(push_constant) uniform Push { LoadPush push; };
layout(std430, binding = 2) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 3) buffer SolidLoadBlock { SolidLoadRecord solidLoads[]; };
layout(std430, binding = 4) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 5) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 6) buffer SumsBlock { FluidSums sums; };
#include "fluid/bodies.glsl"
#include "fluid/solid_impulses.glsl"

void moveBody(uint n, vec3 impulse, vec3 moment) {
  BodyRecord b = bodies[n];
  if (b.held != 0u || b.stopped != 0u) return;
  PoseRecord s = b.state;
  vec3 v = velocityOf(s) + inverseMass(b) * impulse;
  vec3 w = angularVelocity(s) + inverseInertiaAt(b, rotationOf(s)) * aboutMass(b, s, impulse, moment);
  const float kMaxSpeed = 1.0e15;
  if (!isWithin(v, kMaxSpeed) || !isWithin(w, kMaxSpeed)) return;
  s = slowed(poseOf(centerOf(s), rotationOf(s), v, w), b.radius);
  bodies[n].state = s;
  solids[b.solid].pose = solidPose(b, s);
  atomicMax(sums.bodySpeed, floatBitsToUint(length(velocityOf(s)) + b.radius * length(angularVelocity(s))));
}

void main() {
  if (control.phase != kPhaseAdvancing) return;
  bool ends = push.ends != 0u && control.timeLeft <= 0.0;
  for (uint n = gl_LocalInvocationID.x; n < params.solidCount; n += gl_WorkGroupSize.x) {
    float impulse[kLoadComponents];
    for (uint c = 0u; c < kLoadComponents; ++c) {
      impulse[c] = reaction(c, n * kSolidSumWords + kSolveSums) / control.step;
      addImpulse(n, c, impulse[c]);
    }
    if (BODIES && solids[n].body != kNoBody)
      moveBody(solids[n].body, vec3(impulse[0], impulse[1], impulse[2]), vec3(impulse[3], impulse[4], impulse[5]));
    if (ends) endAdvance(n);
  }
}
