#version 460
// The triangles of a solid's mesh; with LIGHT their depth alone, for the shadow map.
#extension GL_GOOGLE_include_directive : require
#define RILL_PUSH_MORE uint part;
#include "render/surface.glsl"
#include "views/particle_records.h"
#include "views/scenery_mesh_records.h"
#include "shared/pose.glsl"

#ifdef LIGHT
#define FIRST_BINDING 0
#else
#define FIRST_BINDING 4
#endif
layout(std430, set = 0, binding = FIRST_BINDING) readonly buffer Placed { PlacedSolid placed[]; };
layout(std430, set = 0, binding = FIRST_BINDING + 1) readonly buffer Parts { MeshPart mesh_parts[]; };
layout(std430, set = 0, binding = FIRST_BINDING + 2) readonly buffer Triangles { MeshTriangle mesh_triangles[]; };
#ifndef LIGHT
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out vec3 base;
layout(location = 3) flat out uint colored;
#endif

vec3 unpackCorner(uint packed) {
  const vec2 p = unpackSnorm2x16(packed);
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  const float fold = max(-n.z, 0.0);
  n.xy += vec2(n.x >= 0.0 ? -fold : fold, n.y >= 0.0 ? -fold : fold);
  return normalize(n);
}

void main() {
  const MeshPart own = mesh_parts[part];
  const uint triangle = own.first + gl_VertexIndex / 3u, corner = gl_VertexIndex % 3u;
  const PoseRecord pose = placed[own.solid].pose;
  vec3 at[3];
  for (uint k = 0u; k < 3u; ++k)
    at[k] = centerOf(pose) + toScene(pose, vec3(mesh_triangles[triangle].corners[3u * k], mesh_triangles[triangle].corners[3u * k + 1u],
                                                mesh_triangles[triangle].corners[3u * k + 2u]));
  const vec3 p = corner == 0u ? at[0] : (corner == 1u ? at[1] : at[2]);
  gl_Position = clipPoint(viewPoint(p));
#ifndef LIGHT
  const vec3 sight = view.perspective > 0.0 ? at[0] - worldPoint(vec3(0.0)) : worldDirection(vec3(0.0, 0.0, 1.0));
  const bool turned = dot(cross(at[1] - at[0], at[2] - at[0]), sight) > 0.0;
  if (turned && own.twoSided == 0u) gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // the inside of a mesh is not drawn
  position = p;
  normal = (turned ? -1.0 : 1.0) * toScene(pose, unpackCorner(mesh_triangles[triangle].normals[corner]));
  base = vec3(mesh_triangles[triangle].red, mesh_triangles[triangle].green, mesh_triangles[triangle].blue);
  colored = own.colored;
#endif
}
