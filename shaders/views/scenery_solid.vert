#version 460
// The box around each solid that is no mesh; its fragments find the solid itself.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "views/particle_records.h"
#include "shared/pose.glsl"
#include "shared/shape.glsl"

#ifdef LIGHT
layout(std430, set = 0, binding = 0) readonly buffer Placed { PlacedSolid placed[]; };
#else
layout(std430, set = 0, binding = 4) readonly buffer Placed { PlacedSolid placed[]; };
#endif
layout(location = 0) flat out uint index;

void main() {
  index = gl_InstanceIndex;
  const PlacedSolid solid = placed[index];
  // Corner n of face f, two triangles a face, seen from either side.
  const int face = gl_VertexIndex / 6, n = gl_VertexIndex % 6;
  const int corner = n < 3 ? n : (n == 3 ? 2 : (n == 4 ? 1 : 3));
  const float side = (face & 1) == 0 ? -1.0 : 1.0, a = (corner & 1) == 0 ? -1.0 : 1.0, b = (corner & 2) == 0 ? -1.0 : 1.0;
  const vec3 unit = face < 2 ? vec3(side, a, b) : (face < 4 ? vec3(a, side, b) : vec3(a, b, side));
  gl_Position = clipPoint(viewPoint(centerOf(solid.pose) + toScene(solid.pose, middleOf(solid.shape) + unit * halfExtents(solid.shape))));
  if (solid.shape.kind == kShapeMesh) gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // drawn as triangles
}
