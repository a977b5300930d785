// The smooth surface along a ray: the zero of the weighted sum of signed distances to planes (implicit moving least squares, Kolluri 2005).
// Needs surface_arrays.glsl; planes at PLANES.
#include "render/surface_cells.glsl"
#include "shared/loops.glsl"
#include "render/surface_silhouette.glsl"
READ_FLOAT4(PLANES, plane)

const float kBlendReach = 1.8;  // spacings, across a plane
const float kBlendRange = 1.2;  // spacings, along its normal
const float kCoverThresholdInside = 0.4;  // among many planes, where a low sum is a gap and not a silhouette
const float kCoverEdgeOn = 0.35;  // minimal weight of a particle, whose plane is seen edge on
const int kMaxRefinements = 2;   // further steps where the first one moved the surface
const float kConverged = 0.25;   // spacings: a step below this is the last
const float kMinPlaneWeight = 0.5;  // weight of planes above which a step's result is used

struct Blend {
  float depth;         // of the surface; the given depth without a surface
  float plane_weight;  // weight of planes minus that of balls
  float coverage;      // of the pixel by fluid: 0.5 at the silhouette
  vec3 normal;         // in view space, towards the eye
};

// One step, evaluated at `depth`.
Blend blendStep(vec2 axis, float depth) {
  const vec3 from = rayFrom(axis), along = rayAlong(axis);
  const float spacing = spacingAt(depth);
  const vec3 x = from + depth * along, sight = normalize(along);
  const float reach = kBlendReach * spacing;
  const float inverse = 1.0 / (reach * reach), range_inverse = 1.0 / (kBlendRange * spacing);
  const CellRange range = cellsAround(x, reach + 0.5 * spacing);
  const float cover_inverse = 1.0 / (kCoverReach * kCoverReach * spacing * spacing);
  float height = 0.0, slope = 0.0, cover = 0.0, sum = 0.0, plane_weight = 0.0;
  vec3 normal = vec3(0.0);
  int y = range.first.y;
  LOOP_WHILE (y <= range.last.y) {
    const uvec2 row = rowOf(range, y);
    uint j = row.x;
    LOOP_WHILE (j < row.y) {
      const vec4 anchor = planeAt(2u * j);
      vec3 n = planeAt(2u * j + 1u).xyz;
      vec3 d = x - anchor.xyz;
      if (anchor.w > 0.0) {  // a ball: its tangent plane nearest to x
        n = d / max(length(d), 1e-3 * spacing);
        d -= 0.5 * spacing * n;
      }
      const float h = dot(d, n);
      const float across = max(1.0 - (dot(d, d) - h * h) * inverse, 0.0);
      const float off = h * range_inverse;
      const float within = max(1.0 - off * off, 0.0);
      const float w = across * across * across * within * within;
      sum += w;
      plane_weight += anchor.w > 0.0 ? -w : w;
      height += w * h;
      slope += w * dot(along, n);
      normal += w * n;
      // Seen edge on, particles of a surface are denser on the screen.
      if (within > 0.0) cover += centerWeight(centerAt(j).xyz, axis, cover_inverse) * max(abs(dot(n, sight)), kCoverEdgeOn);
      ++j;
    } LOOP_END(j < row.y);
    ++y;
  } LOOP_END(y <= range.last.y);
  Blend blend;
  blend.plane_weight = plane_weight;
  blend.coverage = coverageAt(cover - mix(kCoverThresholdPlanes, kCoverThresholdInside, smoothstep(1.5, 2.8, sum)), depth);
  // At grazing angles the quotient is ill-conditioned: limited to the range.
  const float step = slope < -1e-6 ? clamp(height / -slope, -kBlendRange * spacing, kBlendRange * spacing) : 0.0;
  blend.depth = depth + step;
  const float size = length(normal);
  blend.normal = size > 1e-6 ? normal / size : -normalize(along);
  return blend;
}

// At grazing angles the spheres' depth is far off the surface and jumps between spheres, so the result is refined from its own depth.
Blend blendAt(vec2 axis, float depth) {
  Blend blend = blendStep(axis, depth);
  const bool cut = depth <= nearestDrawn();  // by the near plane
  if (cut) blend.normal = -normalize(rayAlong(axis));
  const float converged = kConverged * spacingAt(depth);
  float from = depth;
  int refinements = 0;  // one exit, no break: see docs/notes/lavapipe.md
  bool moves = !cut && blend.plane_weight > kMinPlaneWeight && abs(blend.depth - from) > converged;
  LOOP_WHILE (moves) {
    const Blend next = blendStep(axis, blend.depth);
    moves = next.plane_weight > kMinPlaneWeight;
    if (moves) {
      from = blend.depth;
      blend.depth = next.depth;
      blend.normal = next.normal;
      moves = ++refinements < kMaxRefinements && abs(blend.depth - from) > converged;
    }
  } LOOP_END(moves);
  blend.depth = cut ? nearestDrawn() : max(blend.depth, nearestDrawn());
  return blend;
}
