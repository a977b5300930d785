#version 460
// Moves predicted bodies that are in contact by the sum of the impulses of their contacts.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "shared/pose.glsl"
layout(local_size_x = kFluidGroup) in;
#include "shared/body_records.h"
layout(std430, binding = 2) buffer SolidBlock { SolidRecord solids[]; };
layout(std430, binding = 3) buffer BodyBlock { BodyRecord bodies[]; };
layout(std430, binding = 4) buffer SolidSumsBlock { uint solidSums[]; };
layout(std430, binding = 5) readonly buffer ContactBodiesBlock { uint contactBodies[]; };
#include "fluid/predicted_bodies.glsl"
#include "fluid/solid_sums.glsl"

void main() {
  uint k = flatInvocation();
  float dt = bodyStep();
  if (k >= contactBodies[1]) return;
  uint n = contactBodies[kContactLists + kPointWorkgroups * params.bodyCount + k];
  if (dt <= 0.0 || bodies[n].held != 0u) return;
  BodyRecord b = bodies[n];
  float components[kLoadComponents];
  for (uint c = 0u; c < kLoadComponents; ++c)
    components[c] = b.mass * toDisplacement(c, takeSum(b.solid * kSolidSumWords + kSolveSums + 2u * c));
  vec3 impulse = vec3(components[0], components[1], components[2]);
  vec3 moment = aboutMass(b, b.predicted, impulse, vec3(components[3], components[4], components[5]));
  storePrediction(n, b, pushed(b, b.predicted, impulse, moment, dt));
}
