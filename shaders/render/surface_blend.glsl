// The smooth surface along a ray: where the weighted sum of the planes' heights is zero (implicit moving least squares, Kolluri 2005).
// Needs surface_arrays.glsl; planes at binding 2.
#include "render/surface_walk.glsl"
#include "shared/loops.glsl"
#include "render/surface_edge.glsl"
READ_FLOAT4(2, plane)

const float kBlendReach = 1.8;  // spacings, across a plane
const float kBlendRange = 1.2;  // spacings, along its normal
const float kCoverInside = 0.4;  // in place of kCoverSlanted amid many others: a gap, not an edge
const float kCoverEdgeOn = 0.35;  // weight of a particle whose plane is seen edge on
const int kLooks = 2;           // more of them, where the first moved the surface
const float kStill = 0.25;      // spacings of a move after which none is needed
const float kFirm = 0.5;        // weight of planes from which a look is taken for the surface

struct Blend {
  float depth;     // of the surface; what came in where there is none
  float firm;      // weight of planes less that of balls
  float coverage;  // of the pixel around the ray by fluid: a half at the silhouette
  vec3 normal;     // in view space, towards the eye
};

// As seen from one depth.
Blend lookFrom(vec2 axis, float depth) {
  const vec3 from = rayFrom(axis), along = rayAlong(axis);
  const float spacing = spacingAt(depth);
  const vec3 x = from + depth * along, sight = normalize(along);
  const float reach = kBlendReach * spacing;
  const float inverse = 1.0 / (reach * reach), range_inverse = 1.0 / (kBlendRange * spacing);
  const CellRange range = cellsAround(x, reach + 0.5 * spacing);
  const float cover_inverse = 1.0 / (kCoverReach * kCoverReach * spacing * spacing);
  float height = 0.0, slope = 0.0, cover = 0.0, sum = 0.0, firm = 0.0;
  vec3 normal = vec3(0.0);
  int y = range.first.y;
  LOOP_WHILE (y <= range.last.y) {
    const uvec2 row = rowOf(range, y);
    uint j = row.x;
    LOOP_WHILE (j < row.y) {
      const vec4 anchor = planeAt(2u * j);
      vec3 n = planeAt(2u * j + 1u).xyz;
      vec3 d = x - anchor.xyz;
      if (anchor.w > 0.0) {  // a ball: the plane that touches it where the ray passes
        n = d / max(length(d), 1e-3 * spacing);
        d -= 0.5 * spacing * n;
      }
      const float h = dot(d, n);
      const float across = max(1.0 - (dot(d, d) - h * h) * inverse, 0.0);
      const float off = h * range_inverse;
      const float within = max(1.0 - off * off, 0.0);
      const float w = across * across * across * within * within;
      sum += w;
      firm += anchor.w > 0.0 ? -w : w;
      height += w * h;
      slope += w * dot(along, n);
      normal += w * n;
      // Where the surface is seen edge on, its particles crowd before the eye.
      if (within > 0.0) cover += coverOfCenter(centerAt(j).xyz, axis, cover_inverse) * max(abs(dot(n, sight)), kCoverEdgeOn);
      ++j;
    } LOOP_END(j < row.y);
    ++y;
  } LOOP_END(y <= range.last.y);
  Blend blend;
  blend.firm = firm;
  blend.coverage = coverageAt(cover - mix(kCoverSlanted, kCoverInside, smoothstep(1.5, 2.8, sum)), depth);
  // At grazing angles the sums say little: no farther than the range allows.
  const float step = slope < -1e-6 ? clamp(height / -slope, -kBlendRange * spacing, kBlendRange * spacing) : 0.0;
  blend.depth = depth + step;
  const float size = length(normal);
  blend.normal = size > 1e-6 ? normal / size : -normalize(along);
  return blend;
}

// At a grazing angle the spheres' depth lies far off the surface, and jumps from one to the next: looked at again from what was found.
Blend blendAt(vec2 axis, float depth) {
  Blend blend = lookFrom(axis, depth);
  const bool cut = depth <= nearestDrawn();  // by the near plane, which is seen then
  if (cut) blend.normal = -normalize(rayAlong(axis));
  const float still = kStill * spacingAt(depth);
  float from = depth;
  int turn = 0;  // one exit, no break: see docs/notes/lavapipe.md
  bool moves = !cut && blend.firm > kFirm && abs(blend.depth - from) > still;
  LOOP_WHILE (moves) {
    const Blend next = lookFrom(axis, blend.depth);
    moves = next.firm > kFirm;
    if (moves) {
      from = blend.depth;
      blend.depth = next.depth;
      blend.normal = next.normal;
      moves = ++turn < kLooks && abs(blend.depth - from) > still;
    }
  } LOOP_END(moves);
  blend.depth = cut ? nearestDrawn() : max(blend.depth, nearestDrawn());
  return blend;
}
