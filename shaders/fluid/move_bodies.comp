#version 460
// Moves bodies by the reaction to the fluid's solve, or to an iteration of it. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/solid_loads.h"
layout(local_size_x = 64) in;
#include "shared/body_records.h"
layout(push_constant) uniform Push { LoadPush push; };
layout(std430, binding = 2) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 3) readonly buffer SolidLoadBlock { SolidLoadRecord solidLoads[]; };
layout(std430, binding = 4) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 5) buffer SumsBlock { FluidSums sums; };
layout(std430, binding = 6) writeonly buffer ContactCommandBlock { uint contactCommands[]; };
layout(std430, binding = 7) writeonly buffer PointCommandBlock { uint pointCommands[]; };
#include "fluid/predicted_bodies.glsl"

PoseRecord reacted(BodyRecord b) {
  SolidLoadRecord load = solidLoads[b.solid];
  vec3 impulse = control.step * vec3(load.solve[0], load.solve[1], load.solve[2]);
  vec3 moment = control.step * vec3(load.solve[3], load.solve[4], load.solve[5]);
  return pushed(b, b.predicted, impulse, aboutMass(b, b.predicted, impulse, moment), control.step);
}

// Not too fast, and not through a wall.
PoseRecord bounded(PoseRecord s, vec3 from, float radius) {
  vec3 x = centerOf(s), low = wallsLow(), high = wallsHigh();
  for (int a = 0; a < 3; ++a)
    if (from[a] >= low[a] && from[a] <= high[a]) x[a] = clamp(x[a], low[a], high[a]);
  return slowed(poseOf(x, rotationOf(s), velocityOf(s), angularVelocity(s)), radius);
}

bool inRange(PoseRecord s) {
  const float kMaxSpeed = 1.0e15;  // m/s, and rad/s: its square is a float
  vec4 q = rotationOf(s);
  return isFinite(centerOf(s)) && isWithin(velocityOf(s), kMaxSpeed) && isWithin(angularVelocity(s), kMaxSpeed) && isWithin(q.xyz, 2.0) &&
         isWithin(q.www, 2.0) && dot(q, q) > 0.5;
}

void endSubstep(uint n, BodyRecord b, PoseRecord s) {
  if (control.phase == kPhaseInitialPressure) s = b.state;
  if (!inRange(s)) {
    s = poseOf(centerOf(b.state), rotationOf(b.state), vec3(0.0), vec3(0.0));
    bodies[n].stopped = 1u;
  }
  s = bounded(s, centerOf(b.state), b.radius);
  bodies[n].state = s;
  solids[b.solid].pose = solidPose(b, s);
}

void main() {
  if (push.ends != 0u && gl_LocalInvocationID.x == 0u)  // until the next substep
    contactCommands[0] = contactCommands[3] = pointCommands[0] = 0u;
  for (uint n = gl_LocalInvocationID.x; n < params.bodyCount; n += gl_WorkGroupSize.x) {
    BodyRecord b = bodies[n];
    bool moves = b.held == 0u, last = push.ends != 0u;
    PoseRecord s = b.predicted;
    if (moves && control.phase == kPhaseAdvancing) s = reacted(b);
    if (!last) {
      if (moves) storePrediction(n, b, s);
      continue;
    }
    bodies[n].stiffness = solidLoads[b.solid].stiffness * params.particleMass / (params.spacing * sqrt(b.mass));
    if (moves) endSubstep(n, b, s);
    if (b.stopped != 0u) continue;
    // One that is held has the speed that it will be released with.
    PoseRecord state = bodies[n].state;
    atomicMax(sums.bodySpeed, floatBitsToUint(length(velocityOf(state)) + b.radius * length(angularVelocity(state))));
  }
}
