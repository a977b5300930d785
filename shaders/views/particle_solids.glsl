// Rays against the solids. Needs `poses`.

// Distance along the ray, in lengths of `direction`, to where it enters the solid, and the outward normal; negative for a miss.
float solidHit(PoseRecord pose, vec3 from, vec3 direction, out vec3 normal) {
  const vec3 d = from - pose.center.xyz;
  normal = vec3(0.0, 1.0, 0.0);
  if (pose.center.w > 0.0) {
    const float inverse = 1.0 / dot(direction, direction);
    const float middle = -dot(d, direction) * inverse;
    const vec3 miss = d + middle * direction;
    const float inside = pose.center.w * pose.center.w - dot(miss, miss);
    if (inside <= 0.0) return -1.0;
    const float t = middle - sqrt(inside * inverse);
    normal = (d + t * direction) / pose.center.w;
    return t;
  }
  const vec3 size = vec3(pose.axis_x.w, pose.axis_y.w, pose.axis_z.w);
  const vec3 start = vec3(dot(d, pose.axis_x.xyz), dot(d, pose.axis_y.xyz), dot(d, pose.axis_z.xyz));
  vec3 step = vec3(dot(direction, pose.axis_x.xyz), dot(direction, pose.axis_y.xyz), dot(direction, pose.axis_z.xyz));
  const vec3 side = vec3(step.x < 0.0 ? -1.0 : 1.0, step.y < 0.0 ? -1.0 : 1.0, step.z < 0.0 ? -1.0 : 1.0);
  step = side * max(abs(step), vec3(1e-12));
  const vec3 near = (-side * size - start) / step, far = (side * size - start) / step;
  const float enter = max(near.x, max(near.y, near.z));
  if (enter > min(far.x, min(far.y, far.z))) return -1.0;
  normal = enter == near.x ? -side.x * pose.axis_x.xyz : (enter == near.y ? -side.y * pose.axis_y.xyz : -side.z * pose.axis_z.xyz);
  return enter;
}
