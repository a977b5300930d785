// What starts the dispatches of the fluid's passes, and what they are over.
#ifndef RILL_DISPATCH_COMMANDS_H
#define RILL_DISPATCH_COMMANDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// What starts a dispatch: the host, or a decision of the device (fluid/dispatch_commands.glsl). The
// values of enum Start in engine/fluid/pass_table.hpp.
RILL_CONST uint kStartAlways = 0u;         // the host
RILL_CONST uint kStartPredict = 1u;        // the begin of an advance
RILL_CONST uint kStartDensity = 2u;        // a substep
RILL_CONST uint kStartIterate = 3u;        // a further iteration of it
RILL_CONST uint kStartCorrect = 4u;        // the end of a substep that is recorded with an even number: the density
RILL_CONST uint kStartCorrectOdd = 5u;     // pass of the next one, which does not run, switches it off; with an odd one
RILL_CONST uint kStartNoiseDamping = 6u;   // the end of the first substep of a block, if the fluid is at rest
RILL_CONST uint kStartRebuild = 7u;        // the neighbor list is due
RILL_CONST uint kStartFigures = 8u;        // figures were asked for
RILL_CONST uint kStartFallAsleep = 9u;     // the fluid falls asleep at the begin of an advance
RILL_CONST uint kStartDiffusion = 10u;     // the end of the first substep of a block, if fluids diffuse
RILL_CONST uint kNoSubstep = 2u;           // in place of a parity
RILL_CONST uint kKeepCommands = 3u;        // likewise: the commands stay as they are
RILL_CONST uint kNoBegin = 4u;             // likewise, where an advance continues: nothing is to be predicted

// What it is over.
RILL_CONST uint kOverShape = 0u;           // a number of groups that was fixed when the fluid was made
RILL_CONST uint kOverParticles = 1u;       // all particles
RILL_CONST uint kOverChunk = 2u;           // those of a buffer of the neighbor list
RILL_CONST uint kOverLists = 3u;           // the same, of the variant that reads lists alone: no list overflowed
RILL_CONST uint kOverGrid = 4u;            // the same, of the variant that walks the grid: a list overflowed, or the fluid has no list
RILL_CONST uint kOverNearSolids = 5u;      // the particles near solids
RILL_CONST uint kOverNearMouths = 6u;      // those near mouths of emitters
RILL_CONST uint kOverInReach = 7u;         // those in reach of solids in the substep
RILL_CONST uint kOverNearLists = 8u;       // the particles near solids, of the variant that reads lists alone
RILL_CONST uint kOverNearGrid = 9u;        // the same, of the variant that walks the grid
RILL_CONST uint kMaxCommands = 64u;
RILL_CONST uint kTicketWord = 3u * kMaxCommands;  // behind the commands: invocations of a density pass that have finished

RILL_RECORDS_END
#endif
