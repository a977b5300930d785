#version 460
// Faces of the glass tank: those of panes that face the eye with FRONT, else the others.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "views/glass_records.h"

layout(std430, set = 0, binding = 0) readonly buffer Quads { GlassQuad quads[]; };
layout(location = 0) out vec3 position;
layout(location = 1) flat out vec3 normal;
layout(location = 2) flat out uint edge;

void main() {
  const GlassQuad q = quads[gl_InstanceIndex];
  const vec3 corner = vec3(q.cornerX, q.cornerY, q.cornerZ), outward = vec3(q.outwardX, q.outwardY, q.outwardZ);
  const vec3 first = vec3(q.firstX, q.firstY, q.firstZ), second = vec3(q.secondX, q.secondY, q.secondZ);
  const vec3 from_eye = view.perspective > 0.0 ? corner - worldPoint(vec3(0.0)) : worldDirection(vec3(0.0, 0.0, 1.0));
#ifdef FRONT
  const bool drawn = dot(outward, from_eye) < 0.0;
#else
  const bool drawn = dot(outward, from_eye) >= 0.0;
#endif
  const int n = gl_VertexIndex;
  const int at = n < 3 ? n : (n == 3 ? 2 : (n == 4 ? 1 : 3));
  position = corner + ((at & 1) != 0 ? first : vec3(0.0)) + ((at & 2) != 0 ? second : vec3(0.0));
  normal = normalize(cross(first, second));
  edge = q.edge > 0.0 ? 1u : 0u;
  gl_Position = drawn ? clipPoint(viewPoint(position)) : vec4(0.0, 0.0, -1.0, 1.0);
}
