// How the neighbor list is stored, for C++ and GLSL.
//
// A particle's neighbors are stored in the order of the sorted particles, as 16-bit steps from one to the next, four steps in two words.
// The first step is from the particle's own index less the distance in its list head. A step too long for 16 bits takes an entry of its
// own, which visits the dummy neighbor; so do the entries that fill the last four.
//
// A particle near walls also counts images of neighbors, and of itself, behind them (fluid/images.glsl). Its list is then a sequence of
// segments, at most one for each image: an entry that names the image and how many groups of four entries the segment has, itself among
// them, and neighbors, whose steps start from the same particle in each segment. Image 0, the neighbors themselves, comes first.
//
// In a fluid with surface tension every list is made of segments. Before the others comes one, in place of an image, of the neighbors that
// the solver's kernel does not reach but samples of the surface do.
#ifndef RILL_NEIGHBOR_LIST_H
#define RILL_NEIGHBOR_LIST_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kListBlock = 4096u;  // particles a block of the list: k-major inside a block

// An entry below kLongStep is a step forward. From there on its lower 12 bits are a signed number of 2^kLongStepShift particles. In the
// entry that begins a segment they are its groups and, above them, its image.
RILL_CONST uint kLongStep = 0xF000u;
RILL_CONST uint kLongStepShift = 15u;
RILL_CONST uint kSegmentGroupBits = 7u;
RILL_CONST uint kMaxSegmentGroups = (1u << kSegmentGroupBits) - 1u;
RILL_CONST uint kSegmentImages = 27u;  // images that a segment can name
RILL_CONST uint kDeepSegment = 30u;    // the far neighbors of a particle among so many that no surface is near
RILL_CONST uint kFarSegment = 31u;     // those of another

// List head: the number of entries, kUnlisted if they are more than the list holds; whether a solid is near; whether the list is made of
// segments; whether the particle sleeps; whether the mouth of an emitter is near; and the distance (particles) from which the first step
// starts.
RILL_CONST uint kUnlisted = 1023u;
RILL_CONST uint kNearSolidsBit = 1024u;
RILL_CONST uint kSegmentsBit = 2048u;
RILL_CONST uint kAsleepBit = 4096u;
RILL_CONST uint kNearMouthsBit = 8192u;
RILL_CONST uint kHeadDistanceShift = 14u;
RILL_CONST uint kMaxHeadDistance = (1u << 18) - 1u;

RILL_RECORDS_END
#endif
