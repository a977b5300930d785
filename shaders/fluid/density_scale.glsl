// Factor on the kernel's sum: the lattice of a fill has rest density at the start, and the liquid that it
// becomes after the melting time. See docs/notes/rest-state.md.
#ifndef RILL_FLUID_DENSITY_SCALE_GLSL
#define RILL_FLUID_DENSITY_SCALE_GLSL
float densityScale() {
  float melted = min(control.timeHigh * params.inverseMeltingTime, 1.0);
  return params.valueScale * (1.0 + melted * params.liquidExcess);
}
#endif
