// Answers queries about solids with the geometry that the engine's shaders share.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "solid_query.h"
#include "shared/shape.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Solids { SolidRecord solids[]; };
layout(std430, binding = 1) readonly buffer Keyframes { KeyframeRecord keyframes[]; };
layout(std430, binding = 2) readonly buffer Queries { SolidQuery queries[]; };
layout(std430, binding = 3) writeonly buffer Answers { SolidAnswer answers[]; };
#include "shared/keyframes.glsl"

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= uint(queries.length())) return;
  const SolidQuery q = queries[i];
  const SolidRecord solid = solids[q.solid];
  const PoseRecord pose = keyframedPose(solid.base, solid.firstKey, solid.keyCount, q.time);
  const vec3 x = vec3(q.x, q.y, q.z), v = velocityAt(pose, x);
  vec3 normal, entryNormal;
  const float distance = surfaceDistance(solid.shape, localPoint(pose, x), normal);
  normal = toScene(pose, normal);
  const float entry = rayEntry(solid.shape, localPoint(pose, x), toSolid(pose, vec3(q.alongX, q.alongY, q.alongZ)), entryNormal);
  entryNormal = toScene(pose, entryNormal);
  answers[i] = SolidAnswer(pose, later(pose, q.ahead), distance, normal.x, normal.y, normal.z, v.x, v.y, v.z, entry, entryNormal.x,
                           entryNormal.y, entryNormal.z);
}
