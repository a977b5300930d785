// Regions of the grid that fall asleep on their own: see docs/notes/sleep.md.
#ifndef RILL_REGION_RECORDS_H
#define RILL_REGION_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// Cells of a region along each axis: about five spacings, and at least the list's reach.
RILL_CONST uint kRegionCellsX = 4u;
RILL_CONST uint kRegionCellsY = 2u;
RILL_CONST uint kRegionCellsZ = 2u;

// Whether they are to be looked at before the next substep (FluidControl::regionsDue).
RILL_CONST uint kRegionsDue = 1u;
RILL_CONST uint kRegionsDueAfterRest = 2u;  // and all were at rest: the whole fluid slept

// State of a region.
RILL_CONST uint kRegionEmpty = 0u;
RILL_CONST uint kRegionAwake = 1u;
RILL_CONST uint kRegionAsleep = 2u;

// What substeps do with the particles of a region.
RILL_CONST uint kZoneMoves = 0u;    // all of a substep
RILL_CONST uint kZoneWatched = 1u;  // beside one that moves: its particles are gathered, and the forces on them are, too
RILL_CONST uint kZoneStill = 2u;    // beside a watched one: its particles are gathered
RILL_CONST uint kZoneAsleep = 3u;   // nothing; its particles are sorted behind all others

struct RegionRecord {
  // Sums over its particles at a rebuild, cleared after it.
  uint particles;
  uint motion;                            // squared speeds over gravity times spacing, in kRegionMotionUnit
  uint fastest;                           // bits of the largest speed, m/s
  int driftX, driftY, driftZ;             // velocities over the speed of a fall through a spacing, in kRegionUnit
  int forceX, forceY, forceZ;             // warm-start acceleration plus gravity, over gravity, in kRegionUnit
  uint nearSolid;                         // 1: a solid that holds fluid awake is near a particle
  // State.
  uint state;
  uint woken;                             // 1: by a neighbor; the next rebuild makes it awake
  uint moves;                             // 1: it wakes its neighbors
  uint zone;
  float restShare;                        // share of the time at rest after which it falls asleep
  uint restParticles;                     // when it fell asleep
  float restForceX, restForceY, restForceZ;  // likewise, mean of a particle
};
RILL_CONST uint kMaxRegionParticles = 1000u;  // of more the sums may not fit, and it counts as moving
RILL_CONST float kRegionMotionUnit = 1.0f / 1073741824.0f;
RILL_CONST float kMaxRegionMotion = 1.0f / 256.0f;  // what one particle adds, at most
RILL_CONST float kRegionUnit = 1.0f / 1048576.0f;
RILL_CONST float kMaxRegionTerm = 2.0f;  // likewise

RILL_RECORDS_END
#endif
