#version 460
// A plane per surface particle by weighted principal component analysis of its neighbors, raised to the surface. At a crease neighbors
// off the plane are removed and it is fitted again. Without enough neighbors, or cut by the near plane, a particle is a ball.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"

layout(local_size_x = kSurfaceGroup) in;
#include "render/surface_arrays.glsl"
layout(std430, set = 0, binding = 2) writeonly buffer Plane { vec4 plane[]; };
layout(std430, set = 0, binding = 3) buffer Counters { uint counters[]; };
#include "render/surface_cells.glsl"

const float kMinWeight = 1.5;       // of all neighbors; below it the particle is a ball
const float kMaxFlatness = 0.6;     // smallest over middle eigenvalue; above it the particle is a ball
const float kCrease = 0.04;      // the same ratio; above it two faces may meet and the plane is fitted again
const int kRefits = 2;
// Bias of the first plane towards the eye: a particle on a crease belongs to the visible face in every frame.
const float kLeanToEye = 0.4;
const float kSameFace = 0.9;     // spacings: maximal distance to the last plane in a refit

// The eigenvector of the smallest eigenvalue of a symmetric matrix (a b c; b d e; c e f), and the eigenvalues in ascending order.
vec3 leastDirection(float a, float b, float c, float d, float e, float f, out vec3 values) {
  const float mean = (a + d + f) / 3.0;
  const float p2 = (a - mean) * (a - mean) + (d - mean) * (d - mean) + (f - mean) * (f - mean) + 2.0 * (b * b + c * c + e * e);
  const float p = sqrt(max(p2 / 6.0, 1e-20));
  const float A = (a - mean) / p, B = b / p, C = c / p, D = (d - mean) / p, E = e / p, F = (f - mean) / p;
  const float half_det = 0.5 * (A * (D * F - E * E) - B * (B * F - E * C) + C * (B * E - D * C));
  const float angle = acos(clamp(half_det, -1.0, 1.0)) / 3.0;
  values.z = mean + 2.0 * p * cos(angle);
  values.x = mean + 2.0 * p * cos(angle + 2.0943951);
  values.y = 3.0 * mean - values.x - values.z;
  const vec3 r0 = vec3(a - values.x, b, c), r1 = vec3(b, d - values.x, e), r2 = vec3(c, e, f - values.x);
  const vec3 c0 = cross(r0, r1), c1 = cross(r0, r2), c2 = cross(r1, r2);
  const float s0 = dot(c0, c0), s1 = dot(c1, c1), s2 = dot(c2, c2);
  const vec3 best = s0 >= s1 && s0 >= s2 ? c0 : (s1 >= s2 ? c1 : c2);
  return best / sqrt(max(max(s0, max(s1, s2)), 1e-30));
}

struct Fit {
  float sum;
  vec3 mean, square, mixed;
};

// Weighted moments of the centers around one, in units of the reach. `across`: a plane's normal over the distance to the plane, in these
// units, at which weights are zero; a zero vector: no plane.
Fit fitAround(vec3 own, float inverse, CellRange range, vec3 across) {
  Fit fit = Fit(0.0, vec3(0.0), vec3(0.0), vec3(0.0));
  for (int y = range.first.y; y <= range.last.y; ++y) {
    const uvec2 row = rowOf(range, y);
    for (uint j = row.x; j < row.y; ++j) {
      const vec3 q = (centerAt(j).xyz - own) * inverse;
      const float inside = max(1.0 - dot(q, q), 0.0);
      const float off = dot(q, across);
      const float near = max(1.0 - off * off, 0.0);
      const float w = inside * inside * near * near;
      fit.sum += w;
      fit.mean += w * q;
      fit.square += w * q * q;
      fit.mixed += w * q.xyz * q.yzx;
    }
  }
  fit.sum = max(fit.sum, 1e-6);  // the particle itself may be beyond kMaxInRow of its row
  fit.mean /= fit.sum;
  fit.square = fit.square / fit.sum - fit.mean * fit.mean;
  fit.mixed = fit.mixed / fit.sum - fit.mean.xyz * fit.mean.yzx;
  return fit;
}

void main() {
  const uint k = groupIndex() * kSurfaceGroup + gl_LocalInvocationIndex;
  if (k >= counters[kSurfaceCount]) return;
  const vec3 own = centerAt(k).xyz;
  if (own.z - 0.5 * view.spacing <= view.near_depth) {  // cut by the near plane, where the neighbors' cells may span the picture
    plane[2u * k] = vec4(own, 1.0);
    plane[2u * k + 1u] = vec4(0.0);
    return;
  }
  const float spacing = spacingAt(own.z), reach = view.smoothing * spacing, inverse = 1.0 / reach;
  const CellRange range = cellsAround(own, reach);
  Fit fit = fitAround(own, inverse, range, vec3(0.0));
  vec3 values;
  vec3 normal = leastDirection(fit.square.x, fit.mixed.x, fit.mixed.z, fit.square.y, fit.mixed.y, fit.square.z, values);
  const vec3 towards = view.perspective > 0.0 ? normalize(own) : vec3(0.0, 0.0, 1.0);
  if (dot(normal, towards) > 0.0) normal = -normal;
  const bool sharp = values.x > kCrease * values.y;
  if (sharp) normal = normalize(normal - kLeanToEye * towards);
  for (int refit = 0; refit < kRefits && sharp; ++refit) {
    fit = fitAround(own, inverse, range, normal * (view.smoothing / kSameFace));
    normal = leastDirection(fit.square.x, fit.mixed.x, fit.mixed.z, fit.square.y, fit.mixed.y, fit.square.z, values);
  }
  const bool ball = fit.sum - 1.0 < kMinWeight || values.x > kMaxFlatness * values.y;
  if (dot(normal, towards) > 0.0) normal = -normal;
  const float height = ball ? 0.0 : dot(fit.mean, normal) * reach + 0.5 * view.spacing;
  plane[2u * k] = vec4(own + height * normal, ball ? 1.0 : 0.0);
  plane[2u * k + 1u] = vec4(ball ? vec3(0.0) : normal, 0.0);
  if (bound_hit) atomicAdd(counters[kBoundHits], 1u);
}
