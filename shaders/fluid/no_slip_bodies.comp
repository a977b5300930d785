#version 460
// The velocity of each body after the solve of viscosity, to which the fluid will stick: of body and particles together, so that
// a light body is not carried too far. With m of a particle and the sums over b of no_slip_sums.comp, the changes v of its
// velocity and w of its angular velocity follow from
//   (M / m + sum b) v + w x sum b r = sum b w_i,   sum b r x v + (I / m + sum b (r^2 - r r^T)) w = sum b r x w_i.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/pose.glsl"
#include "shared/body_records.h"
layout(local_size_x = kFluidGroup) in;
layout(std430, binding = 2) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 3) readonly buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 4) buffer SolidSumsBlock { uint solidSums[]; };
#include "fluid/bodies.glsl"
#include "fluid/solid_sums.glsl"

mat3 crossMatrix(vec3 v) { return mat3(0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0); }

void main() {
  uint n = flatInvocation();
  if (n >= params.bodyCount) return;
  float s[kNoSlipComponents];
  for (uint c = 0u; c < kNoSlipComponents; ++c)
    s[c] = kDisplacementUnits * takeSum(params.solidCount * kSolidSumWords + n * kNoSlipSumWords + 2u * c);
  BodyRecord b = bodies[n];
  if (!(s[0] > 0.0) || !(control.step > 0.0) || b.held != 0u || b.stopped != 0u) return;

  // Moments in units of the lever, so velocities of turning times it.
  float lever = params.loadLever, toSpeed = params.spacing / control.step, heavy = b.mass / params.particleMass + s[0];
  vec3 first = vec3(s[1], s[2], s[3]), speed = toSpeed * vec3(s[10], s[11], s[12]), turning = toSpeed * vec3(s[13], s[14], s[15]);
  mat3 second = mat3(s[4], s[9], s[8], s[9], s[5], s[7], s[8], s[7], s[6]), across = crossMatrix(first);
  vec3 axes = freeAxes(b.locked);
  mat3 free = mat3(axes.x, 0.0, 0.0, 0.0, axes.y, 0.0, 0.0, 0.0, axes.z);
  mat3 inertia = inertiaAt(b, rotationOf(b.state)) / (params.particleMass * lever * lever) + mat3(s[4] + s[5] + s[6]) - second +
                 across * free * across / heavy;
  vec3 turn = inverseFree(inertia, inertia[0].x + inertia[1].y + inertia[2].z, b.locked) * (turning - cross(first, axes * speed) / heavy);
  vec3 change = axes * (speed + cross(first, turn)) / heavy;
  turn /= lever;
  const float kMaxSpeed = 1.0e15;
  if (!isWithin(change, kMaxSpeed) || !isWithin(turn, kMaxSpeed)) return;
  PoseRecord moved = poseOf(centerOf(b.state), rotationOf(b.state), velocityOf(b.state) + change, angularVelocity(b.state) + turn);
  solids[b.solid].pose = solidPose(b, moved);
}
