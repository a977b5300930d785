// Whether the spheres leave no gap around a sample: then there is fluid, whatever the particles nearest to the ray say. Needs `depth`.
bool solidAround(ivec2 at) {
  const ivec2 grid = ivec2(sampleGrid());
  if (any(lessThan(at, ivec2(2))) || any(greaterThanEqual(at, grid - 2))) return false;
  for (int y = at.y - 2; y <= at.y + 2; ++y)
    for (int x = at.x - 2; x <= at.x + 2; ++x)
      if (depth[uint(y * grid.x + x)] == kInfiniteBits) return false;
  return true;
}
