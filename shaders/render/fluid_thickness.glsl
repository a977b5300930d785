// Thickness of the fluids at a pixel, interpolated between samples. A sample is of a cell of `look.finish.y` pixels a side.
// Needs `look`, thicknessAt(), scene_depth.glsl and FLUIDS.

// The four samples around a pixel, and how far it is between them.
struct Around {
  uvec4 samples;
  vec2 part;
  uint grid;  // samples of a grid
};
Around around(vec2 pixel) {
  const uint cell = uint(look.finish.y);
  const ivec2 grid = ivec2((uvec2(view.width, view.height) + cell - 1u) / cell);
  const vec2 at = clamp(pixel / float(cell) - 0.5, vec2(0.0), vec2(grid) - 1.0);
  const ivec2 base = ivec2(at), next = min(base + 1, grid - 1);
  return Around(uvec4(base.y * grid.x + base.x, base.y * grid.x + next.x, next.y * grid.x + base.x, next.y * grid.x + next.x),
                at - vec2(base), uint(grid.x * grid.y));
}

// Length of the ray in one of the fluids, m.
float thicknessOf(uint fluid, Around near) {
  const uvec4 s = near.samples + fluid * near.grid;
  const float a = float(thicknessAt(s.x)), b = float(thicknessAt(s.y)), c = float(thicknessAt(s.z)), d = float(thicknessAt(s.w));
  return mix(mix(a, b, near.part.x), mix(c, d, near.part.x), near.part.y) * look.finish.z;
}
float thicknessOver(Around near) {
  float sum = thicknessOf(0u, near);
  for (uint fluid = 1u; fluid < FLUIDS; ++fluid) sum += thicknessOf(fluid, near);
  return sum;
}
float thicknessAtPixel(vec2 pixel) { return thicknessOver(around(pixel)); }
// The same of a pixel that sees the fluid from depth z to the scene's. Samples where the scene is nearer than half of that have less fluid
// in front of it; the next ones take their place.
float thicknessToScene(ivec2 pixel, float z) {
  const Around near = around(vec2(pixel) + 0.5);
  const float least = 0.5 * (z + sceneDepth(uvec2(pixel)));
  const uint cell = uint(look.finish.y), columns = (view.width + cell - 1u) / cell;
  bvec4 seen;
  for (int k = 0; k < 4; ++k) {
    const uvec2 own = uvec2(near.samples[k] % columns, near.samples[k] / columns);
    const uvec2 at = min(own * cell + cell / 2u, uvec2(view.width, view.height) - 1u);
    seen[k] = sceneDepth(at) >= least;
  }
  if (!any(seen)) return thicknessOver(near);
  const uvec4 across = mix(near.samples, near.samples.yxwz, not(seen));
  const bvec4 found = bvec4(seen.x || seen.y, seen.x || seen.y, seen.z || seen.w, seen.z || seen.w);
  return thicknessOver(Around(mix(across, across.zwxy, not(found)), near.part, near.grid));
}

// Depth where one of several fluids begins, in m; noDepth() without any.
float beginOf(uint fluid, Around near) {
  const uvec4 s = near.samples + (FLUIDS + fluid) * near.grid;
  const vec2 rest = 1.0 - near.part;
  const vec4 shares = vec4(rest.x * rest.y, near.part.x * rest.y, rest.x * near.part.y, near.part.x * near.part.y);
  float sum = 0.0, weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    const uint bits = thicknessAt(s[k]);
    if (bits == 0u) continue;
    sum += shares[k] * uintBitsToFloat(~bits);
    weights += shares[k];
  }
  return weights > 1e-3 ? sum / weights : noDepth();
}
