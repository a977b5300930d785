#version 460
// Where bodies are at the end of the substep at hand, before contacts and the fluid's solve: by their velocity, gravity, the load of the
// fluid's warm start, and the host's pulls. They turn by the angular velocity of the substep's middle, which keeps the energy of tumbling
// to second order. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/solid_loads.h"
layout(local_size_x = 64) in;
#include "shared/body_records.h"
layout(std430, binding = 2) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 3) readonly buffer SolidLoadBlock { SolidLoadRecord solidLoads[]; };
layout(std430, binding = 4) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 5) readonly buffer PullBlock { PullRecord pulls[]; };
layout(std430, binding = 6) writeonly buffer ContactCandidateBlock { uvec2 contactCandidates[]; };
layout(std430, binding = 7) writeonly buffer ContactBodiesBlock { uint contactBodies[]; };
layout(std430, binding = 8) writeonly buffer ContactCommandBlock { uint contactCommands[]; };
layout(std430, binding = 9) writeonly buffer PointCommandBlock { uint pointCommands[]; };
#include "fluid/predicted_bodies.glsl"
#include "fluid/pulls.glsl"

PoseRecord predictedPose(uint n, BodyRecord b, float dt) {
  PoseRecord s = b.state;
  SolidLoadRecord load = solidLoads[b.solid];
  vec3 force = vec3(load.warm[0], load.warm[1], load.warm[2]);
  vec3 moment = aboutMass(b, s, force, vec3(load.warm[3], load.warm[4], load.warm[5]));
  bool advances = control.nextPhase == kPhaseAdvancing;  // the initial pressure balances weight, not motion
  vec3 before = advances ? velocityOf(s) : vec3(0.0), turning = advances ? angularVelocity(s) : vec3(0.0);
  vec3 v = before + dt * (freeAxes(b.locked) * gravity() + inverseMass(b) * force);
  vec4 q = rotationOf(s);
  vec3 momentum = inertiaAt(b, q) * turning + dt * moment;
  mat3 inverted = inverseInertiaAt(b, q);
  if (advances) addPulls(n, b, q, inverted, dt, v, momentum);
  vec3 halfway = inverseInertiaAt(b, turned(q, 0.5 * dt * (inverted * momentum))) * momentum;
  vec4 after = turned(q, dt * halfway);
  return poseOf(centerOf(s) + dt * v, after, v, inverseInertiaAt(b, after) * momentum);
}

// No contacts have been found yet.
void beginContacts() {
  contactCandidates[0] = uvec2(0u);
  contactBodies[0] = contactBodies[1] = 0u;
  for (uint k = 0u; k < 3u; ++k) {
    uint groups = k == 0u ? 0u : 1u;
    contactCommands[k] = contactCommands[3u + k] = pointCommands[k] = groups;
  }
}

void main() {
  if (gl_LocalInvocationID.x == 0u) beginContacts();
  float dt = bodyStep();
  for (uint n = gl_LocalInvocationID.x; n < params.bodyCount; n += gl_WorkGroupSize.x) {
    BodyRecord b = bodies[n];
    bool held = control.timeHigh < b.from || b.stopped != 0u;
    bodies[n].held = uint(held);
    PoseRecord s = b.state;
    if (held)
      s = poseOf(centerOf(s), rotationOf(s), vec3(0.0), vec3(0.0));
    else if (dt > 0.0)
      s = predictedPose(n, b, dt);
    storePrediction(n, b, s);
  }
}
