// Emitters, drains and the ledger of particles on the device: see docs/notes/flows.md.
#ifndef RILL_FLOW_RECORDS_H
#define RILL_FLOW_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kMaxBornLayers = 4u;   // of an emitter at a rebuild; more wait for the next one
RILL_CONST float kLateLayers = 0.25f;  // by how many layers a birth may be late before the list is rebuilt for it
RILL_CONST float kThickestLayer = 1.5f;  // spacings, of a jet that bears pressure; thicker layers are single particles
RILL_CONST float kNever = 1.0e30f;     // s
RILL_CONST uint kHalfLayer = 0x80000000u;  // phase at the start: the first layer is due when half of it has left

RILL_CONST uint kFluidLedgers = 8u;        // one for each of several fluids

// Shapes of mouths.
RILL_CONST uint kRectMouth = 0u;
RILL_CONST uint kDiscMouth = 1u;
RILL_CONST uint kMeshMouth = 2u;  // the place of its points, with what is nearer to them than a spacing

RILL_CONST uint kNoRoom = 1u;   // the capacity, or the ids, did not do for a whole layer
RILL_CONST uint kCovered = 2u;  // a part of the mouth is in a solid or behind a wall

struct EmitterRecord {
  // What a host may change, first. Of a mouth that keyframes move, before its motion.
  float centerX, centerY, centerZ;  // m, of the mouth, relative to the particles' origin
  float speed;                      // m/s, of particles that leave
  float normalX, normalY, normalZ;  // unit vector, direction of the flow
  float rate;                       // layers of particles a second; 0: closed
  float acrossX, acrossY, acrossZ;  // unit vectors of the mouth's lattice
  float upX, upY, upZ;
  float halfAcross, halfUp;         // m, half the mouth's size; of a round one its radius
  float from, until;                // s
  uint firstPoint, points;          // of its layer, among the mouths' points, by rows along `across`
  uint shape;                       // kRectMouth and so on
  uint firstKey, keyCount;          // of its motion, entries of the keyframe buffer
  float motionSpeed;                // m/s, at most, of the mouth's own motion
  float armX, armY, armZ;           // m, from what it turns about to its center, before its motion
  uint fluid;                       // index of what leaves it
  // State.
  uint phase;                       // of the layer that leaves, in units of 2^-32
  uint due;                         // layers to be born at the next rebuilds
  float opened;                     // layers that have left since it opened, at most 1
  float age, interval;              // s since the last of them was due, and between them
  float doneHigh, doneLow;          // s, the time up to which it is accounted for, as the sum of two floats
  uint emitted;                     // particles since the start
  uint blocked;                     // of the last layer: kNoRoom, kCovered
  float blockedHigh, blockedLow;    // s since the start, in which it was, as the sum of two floats
  uint layers, waiting;             // born at this rebuild, and due but not
  uint firstCandidate;              // of their particles
};

struct DrainRecord {
  float lowX, lowY, lowZ;     // m, box: corners; sphere: its center
  float from;                 // s
  float highX, highY, highZ;  // m; sphere: its radius in x
  float until;                // s
  uint sphere;                // 1: a sphere
  uint drained;               // particles since the start
};

// The ledger: filled + emitted = present + drained + left + inactive.
struct FlowRecord {
  uint filled;               // particles at the start, inactive ones among them
  uint inactive;             // of those
  uint emitted;              // since the start
  uint drained;
  uint left;                 // through open sides
  uint nextId;
  uint outOfIds;             // 1: emitters stopped because ids ran out
  uint full;                 // 1: emitters found no room at some time
  float blockedHigh, blockedLow;  // s, in which some emitter was blocked, as the sum of two floats
  // Of the last rebuild.
  uint firstBorn;            // entry of the first birth
  uint candidates;
  // Of each of several fluids, as above.
  uint filledOf[kFluidLedgers], inactiveOf[kFluidLedgers], emittedOf[kFluidLedgers], drainedOf[kFluidLedgers], leftOf[kFluidLedgers];
};

struct EmissionPush {
  float advance;  // s, of the advance that begins; 0 at a rebuild
  uint births;    // 1: at a rebuild, layers that are due are born
  uint queued;    // as in BeginPush
};

RILL_RECORDS_END
#endif
