// Constants of the samples of a surface. Lengths are in spacings. See engine/sph/surface_tension.hpp.
#ifndef RILL_SURFACE_TENSION_H
#define RILL_SURFACE_TENSION_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kTensionSamples = 20u;
RILL_CONST float kTensionRadius = 1.2f;       // r, from a particle to its samples
RILL_CONST float kTensionSupport = 2.0f;      // s, from a sample to the particles that cover it
RILL_CONST float kTensionAmplitude = 0.25f;   // C
RILL_CONST float kTensionCalibration = 0.36f;  // a
RILL_CONST float kTensionReach = 3.2f;        // r + s

// Forces over rate (engine/sph/surface_tension.hpp) are added up as integers, so many of them a spacing. What one particle's samples do to
// another is clamped to kMaxTension; 12 spacings are the most that occurs.
RILL_CONST float kTensionUnits = 1048576.0f;
RILL_CONST float kMaxTension = 100.0f * kTensionUnits;
RILL_CONST uint kMaxSurfaceChunks = 16u;  // of the list of particles near surfaces: as many as of the neighbor list

// Coordinates of the corners of a dodecahedron: 1 / sqrt(3), and that over and times the golden ratio.
RILL_CONST float kTensionA = 0.57735026919f;
RILL_CONST float kTensionB = 0.35682208977f;
RILL_CONST float kTensionC = 0.93417235896f;

RILL_RECORDS_END
#endif
