// Constants of whitewater and what its passes share. Units are SI unless a comment says otherwise.
#ifndef RILL_WHITEWATER_RECORDS_H
#define RILL_WHITEWATER_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kWhiteGroup = 64u;             // invocations of a workgroup
RILL_CONST float kWhiteSupport = 2.0f;         // radius of the kernel, spacings
RILL_CONST uint kWhiteMaxVisits = 4096u;       // particles that one sum looks at
RILL_CONST uint kWhiteMaxBirths = 1024u;       // of one fluid particle in one step
RILL_CONST uint kWhiteNone = 0xffffffffu;      // no bin
RILL_CONST float kWhiteFar = 1048576.0f;       // cells from the origin beyond which particles are left out

// Emission. The specific kinetic energy from which on water entrains air, that of 1 m/s (Chanson 1996), and that of whole rates.
RILL_CONST float kWhiteEnergyLow = 0.5f, kWhiteEnergyHigh = 4.5f;  // J/kg
RILL_CONST float kWhiteSlow = 0.5f;            // (m/s)^2, of the squared speed; slower fluid does not emit
RILL_CONST float kWhiteInertiaLow = 2.0f, kWhiteInertiaHigh = 4.0f;  // acceleration of the flow over gravity, from smooth to broken up
RILL_CONST float kWhiteCrestCosine = 0.6f;     // between velocity and normal, above which a crest breaks (Ihmsen et al. 2012)
RILL_CONST float kWhiteSpread = 0.1f;          // random part of a new particle's velocity, of its speed

// Classes of diffuse particles. They follow from the fluid's share of the space around a particle.
RILL_CONST uint kWhiteSpray = 0u, kWhiteFoam = 1u, kWhiteBubble = 2u, kWhiteClasses = 3u;
RILL_CONST float kWhiteSprayBelow = 0.2f;      // half a spacing above a plane surface
RILL_CONST float kWhiteBubbleAbove = 0.8f;     // half a spacing below it

// Motion and life.
RILL_CONST float kWhiteRise = 0.25f;           // m/s, terminal speed of bubbles of 2 to 15 mm (Clift, Grace and Weber 1978)
RILL_CONST float kWhiteBubbleAging = 0.25f;    // seconds of age a second under water

RILL_CONST float kWhiteClearance = 0.01f;      // spacings that particles keep from solids

// Words of the counts.
RILL_CONST uint kWhiteCount = 0u;              // diffuse particles
RILL_CONST uint kWhiteSprayCount = 1u;         // of each class, in the order of the classes
RILL_CONST uint kWhiteEmitted = 4u;            // since the start, low and high word, as are the next two
RILL_CONST uint kWhiteDissolved = 6u;
RILL_CONST uint kWhiteOverflow = 8u;           // not emitted for lack of room
RILL_CONST uint kWhiteSteps = 10u;             // since the start
RILL_CONST uint kWhiteBoundHits = 11u;         // sums that kWhiteMaxVisits has cut off, since the start
RILL_CONST uint kWhiteLost = 12u;              // of the step: births that kWhiteMaxBirths has cut off
RILL_CONST uint kWhiteBefore = 13u;            // diffuse particles at the begin of the step
RILL_CONST uint kWhiteCountWords = 16u;

struct WhitePush {
  float spacing;                      // m
  float seconds;                      // of the step
  float gravityX, gravityY, gravityZ; // m/s^2
  float lowX, lowY, lowZ;             // m, the domain
  float highX, highY, highZ;
  uint walls;                         // bits of closed sides: -x +x -y +y -z +z
  uint capacity;                      // fluid particles that there is room for
  uint particles;                     // of the state at most
  uint room;                          // diffuse particles at most
  uint bins;                          // a power of two
  float parcel;                       // m^3 of fluid that a diffuse particle stands for
  float trapping;                     // parcels' volume that shear traps, of the fluid's volume times its strain rate
  float breaking;                     // that crests throw, of their area times their speed
  float life;                         // s, mean of foam
  uint seed;
  uint solids;                        // that hold diffuse particles back
};

RILL_RECORDS_END
#endif
