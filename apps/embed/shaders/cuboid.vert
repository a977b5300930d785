#version 450
// A cuboid of 36 vertices, computed from the vertex index.
layout(push_constant) uniform Push {
  mat4 clip_from_local;
  vec4 low, high, color;  // w: direction to the light
};
layout(location = 0) out vec3 shade;

void main() {
  const int side = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
  const int axis = side / 2;
  const bvec2 at = bvec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5);
  vec3 unit = vec3(0);
  unit[axis] = float(side % 2);
  unit[(axis + 1) % 3] = float(at.x);
  unit[(axis + 2) % 3] = float(at.y);
  vec3 normal = vec3(0);
  normal[axis] = float(side % 2 * 2 - 1);
  shade = color.rgb * (0.55 + 0.45 * max(dot(normal, normalize(vec3(low.w, high.w, color.w))), 0.0));
  gl_Position = clip_from_local * vec4(mix(low.xyz, high.xyz, unit), 1);
}
