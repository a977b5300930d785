// How long the next substep is: as long as the CFL bound and the tolerance allow, fitted to what is left of the advance.
#ifndef RILL_STEP_PLAN_GLSL
#define RILL_STEP_PLAN_GLSL
// The step that the bounds ask for. `last` is the step that gave `error`, s.
float desiredStep(float last, float speed, float error, float acceleration) {
  float reach = params.cfl * params.spacing;
  // The fastest particle goes on accelerating while the step lasts: speed * t + acceleration * t^2 = reach.
  float byCfl = 2.0 * reach / (speed + sqrt(speed * speed + 4.0 * acceleration * reach) + 1.0e-20);
  float step = min(params.maxStep, byCfl);
  if (params.tolerance > 0.0 && last > 0.0) {
    // A prediction's error grows with the square of the step.
    float ratio = sqrt(params.tolerance / max(error, 1.0e-9));
    step = min(step, last * clamp(ratio, 0.7, 1.15));
  }
  return step;
}

// The advance's rest in equal substeps of at most `wanted` seconds; what does not fit in `allowed` substeps is left to be dropped.
float fittedStep(float rest, float wanted, uint allowed) {
  float pieces = ceil(rest / wanted - 1.0e-3);
  return rest / max(pieces, 1.0);
}
#endif
