#version 460
// The box around each solid; its fragments find the solid itself.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "views/particle_records.h"

#ifdef LIGHT
layout(std430, set = 0, binding = 0) readonly buffer Poses { PoseRecord poses[]; };
#else
layout(std430, set = 0, binding = 4) readonly buffer Poses { PoseRecord poses[]; };
#endif
layout(location = 0) flat out uint solid;

void main() {
  solid = gl_InstanceIndex;
  const PoseRecord pose = poses[solid];
  // Corner n of face f, two triangles a face, seen from either side.
  const int face = gl_VertexIndex / 6, n = gl_VertexIndex % 6;
  const int corner = n < 3 ? n : (n == 3 ? 2 : (n == 4 ? 1 : 3));
  const float side = (face & 1) == 0 ? -1.0 : 1.0, a = (corner & 1) == 0 ? -1.0 : 1.0, b = (corner & 2) == 0 ? -1.0 : 1.0;
  const vec3 unit = face < 2 ? vec3(side, a, b) : (face < 4 ? vec3(a, side, b) : vec3(a, b, side));
  const vec3 size = pose.center.w > 0.0 ? vec3(pose.center.w) : vec3(pose.axis_x.w, pose.axis_y.w, pose.axis_z.w);
  const vec3 p = pose.center.xyz + unit.x * size.x * pose.axis_x.xyz + unit.y * size.y * pose.axis_y.xyz +
                 unit.z * size.z * pose.axis_z.xyz;
  gl_Position = clipPoint(viewPoint(p));
}
