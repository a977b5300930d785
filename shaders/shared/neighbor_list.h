// How the neighbor list is stored, for C++ and GLSL.
//
// A particle's neighbors are stored in the order of the sorted particles, as 16-bit steps from one to the next, four steps in two words.
// The first step is from the particle's own index less the distance in its list head. A step too long for 16 bits takes an entry of its
// own, which visits the dummy neighbor; so do the entries that fill the last four.
#ifndef RILL_NEIGHBOR_LIST_H
#define RILL_NEIGHBOR_LIST_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kListBlock = 4096u;  // particles a block of the list: k-major inside a block

// An entry below kLongStep is a step forward. From there on its lower 12 bits are a signed number of 2^kLongStepShift particles.
RILL_CONST uint kLongStep = 0xF000u;
RILL_CONST uint kLongStepShift = 15u;

// List head: the number of entries, kUnlisted if they are more than the list holds; whether walls or solids are near; and the distance
// (particles) from which the first step starts.
RILL_CONST uint kUnlisted = 1023u;
RILL_CONST uint kNearWallsBit = 1024u;
RILL_CONST uint kHeadDistanceShift = 11u;
RILL_CONST uint kMaxHeadDistance = (1u << 21) - 1u;

RILL_RECORDS_END
#endif
