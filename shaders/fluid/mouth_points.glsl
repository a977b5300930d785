// The points of a mouth, which lie by rows, and where the layers of a mesh mouth are: within a spacing of them. Needs `emitters` and
// `mouthPoints`.
#ifndef RILL_MOUTH_POINTS_GLSL
#define RILL_MOUTH_POINTS_GLSL

// The first point of a mouth in or behind a row and column, m.
uint firstMouthPoint(uint e, float row, float column) {
  uint low = emitters[e].firstPoint, high = low + emitters[e].points;
  while (low < high) {
    uint middle = (low + high) / 2u;
    vec2 point = mouthPoints[middle];
    if (point.y < row || (point.y == row && point.x < column)) low = middle + 1u; else high = middle;
  }
  return low;
}

// Whether a point is nearer to `place` than `reach`, and what leads to the place from the nearest one.
bool isNearMouthPoint(uint e, vec2 place, float reach, out vec2 nearest) {
  uint end = emitters[e].firstPoint + emitters[e].points, k = firstMouthPoint(e, place.y - reach, -kNever);
  nearest = vec2(reach, 0.0);
  while (k < end && mouthPoints[k].y < place.y + reach) {
    float row = mouthPoints[k].y;
    for (k = firstMouthPoint(e, row, place.x - reach); k < end && mouthPoints[k].y == row && mouthPoints[k].x < place.x + reach; ++k) {
      vec2 from = place - mouthPoints[k];
      if (dot(from, from) < dot(nearest, nearest)) nearest = from;
    }
    k = firstMouthPoint(e, row, kNever);
  }
  return dot(nearest, nearest) < reach * reach;
}

// The shortest displacement out of the layers, along `across`, `up` and the normal, of what is `forward` and `backward` from leaving them
// along the normal. Sideways it leads away from the nearest point, unless others are there.
vec3 displacementFromPoints(uint e, vec2 place, float forward, float backward) {
  vec2 from, other;
  if (!isNearMouthPoint(e, place, params.spacing, from)) return vec3(0.0);
  float apart = length(from), aside = params.spacing - apart;
  vec2 outward = from * (aside / max(apart, 1.0e-20));
  if (aside < min(forward, backward) && !isNearMouthPoint(e, place + outward, 0.8 * params.spacing, other)) return vec3(outward, 0.0);
  return vec3(0.0, 0.0, forward < backward ? forward : -backward);
}
#endif
