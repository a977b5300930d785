// The frame of an emitter's mouth at a time, and how it moves. Needs `emitters` and `keyframes`.
#ifndef RILL_MOUTH_FRAME_GLSL
#define RILL_MOUTH_FRAME_GLSL
#include "fluid/constants.glsl"
#include "shared/keyframes.glsl"

struct MouthFrame {
  PoseRecord pose;  // of the mouth's center; without motion its axes are those of the scene
  vec3 normal, across, up;
};

MouthFrame mouthFrame(uint e, float time) {
  vec3 center = vec3(emitters[e].centerX, emitters[e].centerY, emitters[e].centerZ);
  vec3 normal = vec3(emitters[e].normalX, emitters[e].normalY, emitters[e].normalZ);
  vec3 across = vec3(emitters[e].acrossX, emitters[e].acrossY, emitters[e].acrossZ);
  vec3 up = vec3(emitters[e].upX, emitters[e].upY, emitters[e].upZ);
  PoseRecord rest = poseOf(center, vec4(0.0, 0.0, 0.0, 1.0), vec3(0.0), vec3(0.0));
  if (!MOUTHS_MOVE || emitters[e].keyCount == 0u) return MouthFrame(rest, normal, across, up);
  vec3 arm = vec3(emitters[e].armX, emitters[e].armY, emitters[e].armZ);
  PoseRecord pivot = poseOf(center - arm, vec4(0.0, 0.0, 0.0, 1.0), vec3(0.0), vec3(0.0));
  PoseRecord pose = keyframedPose(pivot, emitters[e].firstKey, emitters[e].keyCount, time);
  if (emitters[e].shape == kMeshMouth) {
    vec3 moved = centerOf(pose) + toScene(pose, arm);
    pose = poseOf(moved, rotationOf(pose), velocityAt(pose, moved), angularVelocity(pose));
  }
  return MouthFrame(pose, toScene(pose, normal), toScene(pose, across), toScene(pose, up));
}
#endif
