// Whether the spheres leave no gap around a place: then there is fluid, whatever the particles nearest to the ray say. Needs `depth`.

const float kSolid = 0.9683;  // share of the samples within two and a half that spheres cover; none that straight edges have exactly

// That share around a place among the samples (whole numbers are samples); none at the margin's end.
float solidShare(vec2 at) {
  const ivec2 grid = ivec2(sampleGrid()), base = ivec2(floor(at));
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
  return covered / 25.0;
}

bool solidAround(ivec2 at) { return solidShare(vec2(at)) >= kSolid; }

// As a pixel's coverage: at a straight edge the share changes by a fifth a sample.
float solidCoverage(vec2 middle) { return clamp(0.5 + (solidShare(sampleOf(middle)) - kSolid) * 5.0 * float(view.step), 0.0, 1.0); }
