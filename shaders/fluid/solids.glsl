// Distance to solids. Needs `params`.
#ifndef RILL_SOLIDS_GLSL
#define RILL_SOLIDS_GLSL
vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

vec3 toLocal(SolidRecord s, vec3 x) {
  return rotate(vec4(-s.rotationX, -s.rotationY, -s.rotationZ, s.rotationW), x - vec3(s.centerX, s.centerY, s.centerZ));
}
vec3 toWorld(SolidRecord s, vec3 v) { return rotate(vec4(s.rotationX, s.rotationY, s.rotationZ, s.rotationW), v); }

// Signed distance to the surface (negative inside) and the outward normal, both in the solid's frame.
float surfaceDistance(SolidRecord s, vec3 local, out vec3 normal) {
  if (s.shape == 1u) {
    float r = length(local);
    normal = r > 1.0e-6 * s.halfX ? local / r : vec3(0.0, 1.0, 0.0);
    return r - s.halfX;
  }
  vec3 half_ = vec3(s.halfX, s.halfY, s.halfZ);
  vec3 side = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(local, vec3(0.0)));
  vec3 beyond = abs(local) - half_;
  vec3 out_ = max(beyond, vec3(0.0));
  float far = length(out_);
  if (far > 0.0) {
    normal = side * out_ / far;
    return far;
  }
  float most = max(beyond.x, max(beyond.y, beyond.z));
  normal = most == beyond.x ? vec3(side.x, 0.0, 0.0) : (most == beyond.y ? vec3(0.0, side.y, 0.0) : vec3(0.0, 0.0, side.z));
  return most;
}
#endif
