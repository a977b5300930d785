// Poses of solids: between the solid's frame and the scene's, and how its points move.
#ifndef RILL_POSE_GLSL
#define RILL_POSE_GLSL
#include "shared/solid_records.h"

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

// The rotation b, then a.
vec4 composed(vec4 a, vec4 b) { return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz)); }

vec3 centerOf(PoseRecord p) { return vec3(p.centerX, p.centerY, p.centerZ); }
vec4 rotationOf(PoseRecord p) { return vec4(p.rotationX, p.rotationY, p.rotationZ, p.rotationW); }
vec3 velocityOf(PoseRecord p) { return vec3(p.velocityX, p.velocityY, p.velocityZ); }
vec3 angularVelocity(PoseRecord p) { return vec3(p.angularX, p.angularY, p.angularZ); }

PoseRecord poseOf(vec3 center, vec4 rotation, vec3 velocity, vec3 angular) {
  return PoseRecord(center.x, center.y, center.z, rotation.x, rotation.y, rotation.z, rotation.w, velocity.x, velocity.y, velocity.z,
                    angular.x, angular.y, angular.z);
}

// A direction in the solid's frame, in the scene's, and the other way round; a point of the scene, in the solid's frame.
vec3 toScene(PoseRecord p, vec3 local) { return rotate(rotationOf(p), local); }
vec3 toSolid(PoseRecord p, vec3 direction) { return rotate(vec4(-p.rotationX, -p.rotationY, -p.rotationZ, p.rotationW), direction); }
vec3 localPoint(PoseRecord p, vec3 x) { return toSolid(p, x - centerOf(p)); }

// Whether x is farther than `reach` from the sphere of this radius around a center.
bool isBeyond(vec3 center, float radius, vec3 x, float reach) {
  vec3 apart = x - center;
  float far = radius + reach;
  return dot(apart, apart) > far * far;
}

// Of the point of the solid that is at x, m/s.
vec3 velocityAt(PoseRecord p, vec3 x) {
  return velocityOf(p) + cross(angularVelocity(p), x - centerOf(p));
}

// A rotation, then that by a rotation vector: tan(a) = a + a^3 / 3 of half the angle, for the small angles of a step.
vec4 turned(vec4 q, vec3 turn) {
  vec3 half_ = 0.5 * turn;
  float square = dot(half_, half_);
  return square > 0.0 ? normalize(composed(vec4(half_ * (1.0 + square / 3.0), 1.0), q)) : q;
}

// The pose `seconds` later, at the same velocities.
PoseRecord later(PoseRecord p, float seconds) {
  vec3 v = velocityOf(p), w = angularVelocity(p);
  return poseOf(centerOf(p) + seconds * v, turned(rotationOf(p), seconds * w), v, w);
}
#endif
