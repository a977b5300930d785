// Levels of the flow's pyramid: a sample covers four of the next finer level. Needs surface_filter.glsl.

// Grid of the level that is twice as fine as this one.
ivec2 finerGrid() {
  const uint step = view.step / 2u;
  return ivec2((uvec2(view.width, view.height) + step - 1u) / step + 4u * view.margin);
}
// Grid of the level that is twice as coarse.
ivec2 coarserGrid() {
  const uint step = view.step * 2u;
  return ivec2((uvec2(view.width, view.height) + step - 1u) / step + view.margin);
}
// Depth difference (m) above which neighboring samples are of two surfaces: a slant of 73 degrees.
float edgeAt(float z) { return max(view.spacing, 3.3 * metersASample(z)); }
