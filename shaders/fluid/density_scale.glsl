// What the kernel's sum is multiplied by: the lattice of a fill has rest density at the start, and the liquid
// that it becomes once it has melted. See docs/notes/rest-state.md.
#ifndef RILL_FLUID_DENSITY_SCALE_GLSL
#define RILL_FLUID_DENSITY_SCALE_GLSL
float densityScale() {
  float melted = min(control.timeHigh * params.inverseMeltingTime, 1.0);
  return params.valueScale * (1.0 + melted * params.liquidExcess);
}
#endif
