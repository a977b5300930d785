// Where shear changes viscosities and the eigenvalues of their solve are beyond what its steps reach, all are scaled: momentum is
// kept only if the steps reach.
#ifndef RILL_VISCOSITY_SCALE_GLSL
#define RILL_VISCOSITY_SCALE_GLSL
float viscosityScale(uint boundBits) {
  float bound = uintBitsToFloat(boundBits);
  return SHEAR_VISCOSITY && bound > params.shearBound ? (params.shearBound - 1.0) / (bound - 1.0) : 1.0;
}
#endif
