// What the passes that measure a fluid's figures share.
#ifndef RILL_MEASURE_RECORDS_H
#define RILL_MEASURE_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// Sums over one workgroup of measure_sums.comp.
struct MeasurePartial {
  float compression, compressionMax;   // fraction of rest density
  float speedMax;                      // m/s
  float mass;                          // sum over active particles, as the next ones, in units of FluidParams::particleMass
  float kinetic;                       // of mass times v^2
  float velocityX, velocityY, velocityZ;  // of mass times velocity
  float positionX, positionY, positionZ;  // of mass times position
  uint outside;
  uint inactive;                         // outside, and in no other figure
};
RILL_CONST uint kMeasureFirst = 107u << 9;          // bin 0: |C| = 2^-20, by the top bits of the float
RILL_CONST uint kMeasureBins = 23u << 9;            // up to 8, 512 bins an octave
RILL_CONST uint kMeasurePartials = 32u;               // workgroups that add up, at most
RILL_CONST uint kMeasureShare = 64u;                  // particles of an invocation, while there are fewer

// Of one of several fluids, by measure_fluids.comp; integers, so that their order does not matter.
struct FluidFigureRecord {
  uint particles;            // active ones
  uint inactive;
  uint errorLow, errorHigh;  // 64-bit sum of compression in units of kErrorUnit
  uint errorMax;             // bits of the largest compression
};
RILL_CONST float kMaxFigureError = 100.0f;  // compression of a particle, at most, in these

// What measure_reduce.comp finds, for the host.
struct MeasureResult {
  MeasurePartial sums;
  float compression99, signedMedian;
};

RILL_RECORDS_END
#endif
