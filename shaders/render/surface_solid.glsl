// Whether the spheres leave no gap around a place: then there is fluid, whatever the particles nearest to the ray say. Needs `depth`.

bool solidAround(ivec2 at) {
  const ivec2 grid = ivec2(sampleGrid()), first = max(at - 2, ivec2(0)), last = min(at + 2, grid - 1);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (depth[uint(y * grid.x + x)] == kInfiniteBits) return false;
  return true;
}

const float kSolid = 0.9683;  // share of half a pixel's coverage; none that straight edges have exactly

// The same between samples, as a pixel's coverage by fluid: from the share of what lies within two
// and a half samples that spheres cover. At a straight edge it changes by a fifth a sample, so that
// the coverage is as wide as a pixel, and 1 where all is covered.
float solidCoverage(vec2 middle) {
  const ivec2 grid = ivec2(sampleGrid());
  const vec2 at = sampleOf(middle);
  const ivec2 base = ivec2(floor(at));
  if (any(lessThan(base, ivec2(2))) || any(greaterThanEqual(base, grid - 3))) return 0.0;
  const vec2 part = at - vec2(base);
  float covered = 0.0;
  for (int y = -2; y <= 3; ++y) {
    const float wy = y == -2 ? 1.0 - part.y : (y == 3 ? part.y : 1.0);
    for (int x = -2; x <= 3; ++x) {
      const float wx = x == -2 ? 1.0 - part.x : (x == 3 ? part.x : 1.0);
      if (depth[uint((base.y + y) * grid.x + base.x + x)] != kInfiniteBits) covered += wx * wy;
    }
  }
  const float slope = max(5.0 * float(view.step), 0.5 / (1.0 - kSolid));
  return clamp(0.5 + (covered / 25.0 - kSolid) * slope, 0.0, 1.0);
}
