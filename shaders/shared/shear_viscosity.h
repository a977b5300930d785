// Bounds of viscosity that depends on shear. Shared by C++ and GLSL. See docs/notes/viscosity.md.
#ifndef RILL_SHADERS_SHARED_SHEAR_VISCOSITY_H
#define RILL_SHADERS_SHARED_SHEAR_VISCOSITY_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN
RILL_CONST float kMinShearRate = 0.01f;    // 1/s: a slower one counts as this, so a fluid that stands creeps by 1 % a second
RILL_CONST float kMaxShearRate = 1.0e4f;   // 1/s
RILL_CONST float kShearMargin = 1.5f;      // of the bound of eigenvalues, for what solids add to them
RILL_CONST float kShearGain = 2.0f;        // of a particle that lacks neighbors, at most
RILL_CONST float kShearDisplacement = 0.05f;  // spacings that a particle follows its change of velocity in a substep, at most
RILL_CONST float kShearOfPairs = 1.3f;     // of the rate that the pairs have: that of a fit is at most so large
RILL_RECORDS_END
#endif
