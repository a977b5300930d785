// Nearest and farthest depth of the spheres in the samples around a pixel; unchanged without spheres. Needs depthAt().
void depthRange(ivec2 own, inout float nearest, inout float farthest) {
  const ivec2 grid = ivec2(sampleGrid());
  for (int y = max(own.y - 1, 0); y <= min(own.y + 1, grid.y - 1); ++y)
    for (int x = max(own.x - 1, 0); x <= min(own.x + 1, grid.x - 1); ++x) {
      const float hard = uintBitsToFloat(depthAt(uint(y * grid.x + x)));
      nearest = min(nearest, hard);
      if (hard < noDepth()) farthest = max(farthest, hard);
    }
}

// The sample that a pixel lies in.
ivec2 sampleOfPixel(uvec2 pixel) { return ivec2(pixel / view.step + view.margin); }
