// Pressure of the fluid at a point: see docs/notes/pressure.md.
#ifndef RILL_PRESSURE_PROBE_H
#define RILL_PRESSURE_PROBE_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

struct PressureProbeRecord {
  float x, y, z;  // m, relative to the particles' origin
  float mean;     // Pa, over the last advance that has ended
  float integralHigh, integralLow;  // Pa s since the start, as the sum of two floats
  float advance;      // Pa s, of the present advance
  float advanceTime;  // s, likewise
  uint covered;   // 1: it was inside a solid in the last substep
};

// Added to the variance of the neighbors' places along each axis, in units of the support's square: where it is 0, so is the gradient.
RILL_CONST float kPressureRidge = 1.0e-3f;
// A probe is in air unless a particle is within this many spacings. Particles beside a corner of three walls are 0.87 away from it.
RILL_CONST float kWetDistance = 1.25f;

RILL_RECORDS_END
#endif
