// How impulses move rigid bodies. Needs `params` and `control`.
#ifndef RILL_BODIES_GLSL
#define RILL_BODIES_GLSL
#include "shared/body_records.h"
#include "shared/pose.glsl"

// 1 along the axes that a body may move along, and turn about.
vec3 freeAxes(uint locked) { return vec3(uvec3(locked & 1u, locked >> 1u & 1u, locked >> 2u & 1u) ^ 1u); }
vec3 freeTurns(uint locked) { return freeAxes(locked >> 3u); }

// s, of the substep at hand; 0: bodies do not move in it.
float bodyStep() { return control.nextPhase == kPhaseSettling ? 0.0 : control.nextStep; }

// m, how near a contact is counted: within it corrections of a substep may make it one.
float contactMargin() { return 0.25 * params.spacing; }

// In the axes of the scene.
mat3 inertiaAt(BodyRecord b, vec4 q) {
  mat3 local = mat3(b.inertiaXX, b.inertiaXY, b.inertiaZX, b.inertiaXY, b.inertiaYY, b.inertiaYZ, b.inertiaZX, b.inertiaYZ, b.inertiaZZ);
  mat3 r = mat3(rotate(q, vec3(1.0, 0.0, 0.0)), rotate(q, vec3(0.0, 1.0, 0.0)), rotate(q, vec3(0.0, 0.0, 1.0)));
  return r * local * transpose(r);
}

// The inverse of an inertia without the rotations that are locked. Over `size` first, so that no product leaves the range of floats.
mat3 inverseFree(mat3 inertia, float size, uint locked) {
  vec3 turns = freeTurns(locked);
  mat3 all = inertia / size, kept;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) kept[i][j] = turns[i] * turns[j] * all[i][j] + (i == j ? 1.0 - turns[i] : 0.0);
  mat3 inverted = inverse(kept);
  for (int i = 0; i < 3; ++i) inverted[i] *= turns[i] * turns / size;
  return inverted;
}

mat3 inverseInertiaAt(BodyRecord b, vec4 q) {
  return inverseFree(inertiaAt(b, q), b.inertiaXX + b.inertiaYY + b.inertiaZZ, b.locked);
}

vec3 inverseMass(BodyRecord b) { return freeAxes(b.locked) / b.mass; }

// w of docs/notes/bodies.md, 1/kg times the square of `direction`: how far a unit impulse along it at `at` moves that point along it.
float mobility(BodyRecord b, vec3 at, vec3 direction) {
  vec3 turn = cross(at - centerOf(b.predicted), direction);
  vec3 turned_ = vec3(b.inverseXX, b.inverseXY, b.inverseZX) * turn.x + vec3(b.inverseXY, b.inverseYY, b.inverseYZ) * turn.y +
                 vec3(b.inverseZX, b.inverseYZ, b.inverseZZ) * turn.z;
  return max(dot(direction, inverseMass(b) * direction) + dot(turn, turned_), 0.0);
}

// Displaced by an impulse times `dt` (kg m) and a moment, with the velocities that follow.
PoseRecord pushed(BodyRecord b, PoseRecord s, vec3 impulse, vec3 moment, float dt) {
  vec3 by = inverseMass(b) * impulse, turn = inverseInertiaAt(b, rotationOf(s)) * moment;
  return poseOf(centerOf(s) + by, turned(rotationOf(s), turn), velocityOf(s) + by / dt, angularVelocity(s) + turn / dt);
}

// No faster than particles may be, for a body whose points are within `radius` (m) of its center of mass: what pushes it may carry it too
// far if it is much lighter than a particle.
PoseRecord slowed(PoseRecord s, float radius) {
  float linear = min(1.0, params.speedLimit / max(length(velocityOf(s)), 1.0e-20));
  float angular = min(1.0, params.speedLimit / max(radius * length(angularVelocity(s)), 1.0e-20));
  return poseOf(centerOf(s), rotationOf(s), linear * velocityOf(s), angular * angularVelocity(s));
}

// The pose of the body's solid, whose center need not be that of mass.
PoseRecord solidPose(BodyRecord b, PoseRecord s) {
  vec3 toCenter = -rotate(rotationOf(s), vec3(b.offsetX, b.offsetY, b.offsetZ));
  return poseOf(centerOf(s) + toCenter, rotationOf(s), velocityOf(s) + cross(angularVelocity(s), toCenter), angularVelocity(s));
}

// A moment about the center of mass, from one about the solid's center.
vec3 aboutMass(BodyRecord b, PoseRecord s, vec3 force, vec3 moment) {
  return moment - cross(rotate(rotationOf(s), vec3(b.offsetX, b.offsetY, b.offsetZ)), force);
}
#endif
