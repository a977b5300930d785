// The four samples around a pixel, each with its plane, and whether they lie on one surface. Needs samplesAt().
const float kCoplanar = 0.35;  // spacings: maximal distance of a sample to the plane through another

struct Corners {
  vec2 part;  // bilinear weights of the last sample
  float depths[4];
  vec3 normals[4], points[4];
  bool coplanar;
};

Corners cornersOf(vec2 middle) {
  const ivec2 grid = ivec2(sampleGrid());
  const vec2 at = sampleOf(middle);
  const ivec2 base = sampleBefore(at);
  Corners c;
  c.part = max(at - vec2(base), vec2(0.0));
  c.coplanar = true;
  for (int k = 0; k < 4; ++k) {
    const ivec2 s = clamp(base + ivec2(k & 1, k >> 1), ivec2(0), grid - 1);
    const uvec2 stored = samplesAt(uint(s.y * grid.x + s.x));
    const vec2 axis = axisOf(samplePixel(s));
    c.depths[k] = uintBitsToFloat(stored.x);
    c.normals[k] = unpackNormal(stored.y);
    c.points[k] = rayFrom(axis) + c.depths[k] * rayAlong(axis);
    c.coplanar = c.coplanar && c.depths[k] < noDepth();
  }
  for (int k = 1; k < 4 && c.coplanar; ++k) {
    const vec3 d = c.points[k] - c.points[0];
    c.coplanar = abs(dot(d, c.normals[0])) < kCoplanar * view.spacing && abs(dot(d, c.normals[k])) < kCoplanar * view.spacing;
  }
  return c;
}
