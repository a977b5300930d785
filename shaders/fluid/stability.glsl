// The longest stable step and the gains at rest, from the fluid's head: gravity times the
// height of its column, m^2/s^2. The formulas are those of engine/fluid/stability_limits.cpp. Needs `params`.
#ifndef RILL_STABILITY_GLSL
#define RILL_STABILITY_GLSL
const float kAddedAtOnce = 1.1;

float longestStep(float head) { return min(params.maxStep, params.stableStep / sqrt(max(head, 1.0e-30))); }

// s, of fluid that has no pressure yet
float firstStep(float head) { return min(longestStep(head), params.toleratedStep / sqrt(max(head, 1.0e-30))); }

// m/s of the fastest particle, from which on the fluid is no longer at rest; 0: never at rest
float motionSpeed(float head) { return params.motionShare * sqrt(2.0 * head); }

float columnLayers(float head) { return head / params.layerHead; }

float warmGainAtRest(float head) {
  float layers = columnLayers(head);
  return min(params.maxWarmGainAtRest, params.layerWarmGainAtRest / max(layers * layers, 1.0e-20));
}

// Of a substep in the means of error and step in a fluid at rest.
float errorRateShareAtRest(float head) { return 1.0 / max(1.0, kErrorSubsteps * columnLayers(head)); }

// Twice the mean height above the lowest particle or below the highest, whichever is less: exact for
// a column, and a splash does not raise it. See docs/notes/column-height.md.
float columnHeight(uint count, uint low, uint high, uint sumLow, uint sumHigh) {
  if (count == 0u) return 0.0;
  float mean = (float(sumHigh) * 4294967296.0 + float(sumLow)) / float(count);
  return 2.0 * min(mean - float(low), float(high) - mean) * params.spacing / kColumnUnits;
}

// 0 along axes that it does not follow.
float columnHead(FluidSums s) {
  vec3 height = vec3(columnHeight(s.columnCountX, s.columnLowX, s.columnHighX, s.columnSumLowX, s.columnSumHighX),
                     columnHeight(s.columnCountY, s.columnLowY, s.columnHighY, s.columnSumLowY, s.columnSumHighY),
                     columnHeight(s.columnCountZ, s.columnLowZ, s.columnHighZ, s.columnSumLowZ, s.columnSumHighZ));
  height = min(max(height, vec3(params.spacing)), vec3(params.columnLimitX, params.columnLimitY, params.columnLimitZ));
  return dot(vec3(params.columnGravityX, params.columnGravityY, params.columnGravityZ), height);
}

#endif
