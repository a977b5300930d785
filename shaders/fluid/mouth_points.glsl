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

// Whether point k lies between two corners. If not, k goes on to the next that may; `end`: behind the mouth's last point.
bool isBetween(uint e, vec2 low, vec2 high, uint end, inout uint k) {
  vec2 point = mouthPoints[k];
  if (point.x >= low.x && point.x < high.x && point.y < high.y) return true;
  k = point.y < high.y ? firstMouthPoint(e, point.y, point.x < low.x ? low.x : kNever) : end;
  return false;
}

// Whether a point is nearer to `place` than `reach`, and what leads to the place from the nearest one.
bool isNearMouthPoint(uint e, vec2 place, float reach, out vec2 nearest) {
  vec2 low = place - reach, high = place + reach;
  uint end = emitters[e].firstPoint + emitters[e].points, k = firstMouthPoint(e, low.y, -kNever);
  nearest = vec2(reach, 0.0);
  while (k < end) {  // each turn goes on by a point at least
    if (!isBetween(e, low, high, end, k)) continue;
    vec2 from = place - mouthPoints[k++];
    if (dot(from, from) < dot(nearest, nearest)) nearest = from;
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
