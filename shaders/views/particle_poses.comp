#version 460
// Poses of the solids at the frame's time; with DRIVEN, of those that the fluid drives where it has them, and fields of meshes.
#extension GL_GOOGLE_include_directive : require
#include "views/particle_view.glsl"

layout(local_size_x = 64) in;
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std430, set = 0, binding = 1) readonly buffer Solids { SceneSolid solids[]; };
layout(std430, set = 0, binding = 2) readonly buffer Keyframes { KeyframeRecord keyframes[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Placed { PlacedSolid placed[]; };
#ifdef DRIVEN
layout(std430, set = 0, binding = 4) readonly buffer FluidSolids { SolidRecord fluidSolids[]; };
#endif
#include "shared/keyframes.glsl"

void main() {
  const uint i = groupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
  if (i >= scene.counts.x) return;
  const SceneSolid solid = solids[i];
  ShapeRecord shape = solid.shape;
  PoseRecord pose = keyframedPose(solid.base, solid.firstKey, solid.keyCount, view.time);
#ifdef DRIVEN
  shape.field = fluidSolids[i].shape.field;
  if (solid.driven != 0u) {
    pose = fluidSolids[i].pose;  // relative to the fluid's origin
    pose.centerX += view.offset[0];
    pose.centerY += view.offset[1];
    pose.centerZ += view.offset[2];
  }
#endif
  const vec3 seen = viewPoint(centerOf(pose));
  placed[i] = PlacedSolid(pose, shape, seen.x, seen.y, seen.z, solid.radius);
}
