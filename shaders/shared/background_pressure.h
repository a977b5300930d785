// How much of its own pressure a particle does not feel: see engine/sph/background_pressure.hpp.
#ifndef RILL_SHARED_BACKGROUND_PRESSURE_H
#define RILL_SHARED_BACKGROUND_PRESSURE_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST float kBackgroundShare = 1.6f;   // of a particle with even support in a flow, 0 .. 2
RILL_CONST float kBackgroundSpeed = 0.06f;  // speed over the root of gravity times spacing at which it is half of that,
RILL_CONST float kCoherentSpeed = 0.02f;    // and mean speed of the neighbors where these all move alike
RILL_CONST float kCoherentNoise = 0.3f;     // difference of a particle from that mean that counts like a mean speed
RILL_CONST float kShallow = 2.0f;           // layers of fluid that a particle is under up to which coherence does not count,
RILL_CONST float kDeep = 5.0f;              // and from which on it does
RILL_CONST float kTooFewNeighbors = 1.5f;   // radius of the kernel's support over the spacing up to which neighbors are too few for it,
RILL_CONST float kEnoughNeighbors = 2.0f;   // and from which on they are enough
RILL_CONST float kEvenSupport = 0.02f;      // |sum grad K| d up to which a support is even,
RILL_CONST float kUnevenSupport = 0.08f;    // and from which on it is not
RILL_CONST float kMinDisplaced = 0.001f;    // |gradient of the density that solids displace| d at which half of what is across is taken out

RILL_RECORDS_END
#endif
