// What the fluid does to solids: sums of a substep, and the loads that follow from them.
#ifndef RILL_SOLID_LOADS_H
#define RILL_SOLID_LOADS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// Components of a load: those of the force, then those of the torque about the solid's center.
RILL_CONST uint kLoadComponents = 6u;

// Sums of a solid over the particles near it, in 64-bit integers of two words, the low one first, so that their order does not matter:
// displacements that the solid gives particles in a substep, in kDisplacementUnits of the spacing, and their moments about its center,
// in these times FluidParams::loadLever. First those of the solve, then those of the warm start, which the next substep applies. Last, of
// bodies, the stiffness of BodyRecord, in kStiffnessUnits of m / (spacing sqrt(mass)).
RILL_CONST uint kSolveSums = 0u;
RILL_CONST uint kWarmSums = 2u * kLoadComponents;
RILL_CONST uint kStiffnessSum = 4u * kLoadComponents;
RILL_CONST uint kSolidSumWords = 4u * kLoadComponents + 2u;
// Behind the sums of all solids, for each body, if fluid sticks to one: sums over the particles near it that
// shaders/fluid/no_slip_bodies.comp needs, with b, r from the center of mass in loadLever, and the velocity w relative to the body, times
// the step, in spacings: b, b r, b r r^T (xx yy zz yz zx xy), b w, b r x w. All in kDisplacementUnits.
RILL_CONST uint kNoSlipComponents = 16u;
RILL_CONST uint kNoSlipSumWords = 2u * kNoSlipComponents;
RILL_CONST float kDisplacementUnits = 1.0f / 1099511627776.0f;  // 2^-40
RILL_CONST float kStiffnessUnits = 1.0f / 1048576.0f;  // so coarse that what a particle adds is one word: a bound need not be exact
RILL_CONST float kMaxStiffness = 2048.0f;              // likewise: what one particle adds, at most
RILL_CONST float kMaxDisplacement = 8.0f;                       // spacings: what one particle adds, at most

// N and N m; N s and N m s. In the axes of the scene, about the solid's center. Without the solid's own weight.
struct SolidLoadRecord {
  float mean[kLoadComponents];         // over the last advance that has ended
  float impulseHigh[kLoadComponents];  // since the start, as the sum of two floats
  float impulseLow[kLoadComponents];
  float advance[kLoadComponents];      // of the present advance
  float advanceTime;                   // s, likewise
  float solve[kLoadComponents];        // N s and N m s, of the solve of the last substep
  float stiffness;                     // kStiffnessSum of the last substep, times kStiffnessUnits
  float warm[kLoadComponents];         // N and N m, of the warm start: the next substep applies it
};

RILL_RECORDS_END
#endif
