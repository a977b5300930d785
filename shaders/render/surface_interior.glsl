// The interior of the fluid on the screen: where spheres leave no gap, coverage is 1 whatever the nearest centers give. Needs depthAt().

bool isInterior(ivec2 at) {
  const ivec2 grid = ivec2(sampleGrid()), first = max(at - 2, ivec2(0)), last = min(at + 2, grid - 1);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (depthAt(uint(y * grid.x + x)) == kNoDepthBits) return false;
  return true;
}

const float kInteriorShare = 0.9683;  // share of covered samples at a coverage of 0.5; a value that straight edges never have exactly

// The same between samples, as a coverage: from the share of covered samples within 2.5 samples. At a straight edge the share changes
// by 1/5 per sample; the slope makes the transition a pixel wide.
float interiorCoverage(vec2 middle) {
  const ivec2 grid = ivec2(sampleGrid());
  const vec2 at = sampleOf(middle);
  const ivec2 base = sampleBefore(at);
  if (any(lessThan(base, ivec2(2))) || any(greaterThanEqual(base, grid - 3))) return 0.0;
  const vec2 part = max(at - vec2(base), vec2(0.0));
  float covered = 0.0;
  for (int y = -2; y <= 3; ++y) {
    const float wy = y == -2 ? 1.0 - part.y : (y == 3 ? part.y : 1.0);
    for (int x = -2; x <= 3; ++x) {
      const float wx = x == -2 ? 1.0 - part.x : (x == 3 ? part.x : 1.0);
      if (depthAt(uint((base.y + y) * grid.x + base.x + x)) != kNoDepthBits) covered += wx * wy;
    }
  }
  const float slope = max(5.0 * float(view.step), 0.5 / (1.0 - kInteriorShare));
  return clamp(0.5 + (covered / 25.0 - kInteriorShare) * slope, 0.0, 1.0);
}
