// Rigid bodies on the device: solids that the fluid moves.
#ifndef RILL_BODY_RECORDS_H
#define RILL_BODY_RECORDS_H
#include "shared/interop.h"
#include "shared/solid_records.h"
RILL_RECORDS_BEGIN

// Where only some of it is read it is read four words at a time (fluid/body_array.glsl).
struct BodyRecord {
  PoseRecord state;                        // of its center of mass, at the end of the last substep
  PoseRecord predicted;                    // in the present substep
  float offsetX, offsetY, offsetZ;         // m, of the center of mass, in the solid's frame
  float radius;                            // m, of the sphere around the center of mass that holds it
  float from;                              // s, held until then
  uint contacts;                           // of the present substep
  float mass;                              // kg
  uint locked;                             // degrees of freedom: bits x y z rx ry rz
  uint held;                               // 1: in the present substep
  uint stopped;                            // 1: for good, since its motion left the range of numbers
  // Sum of m |grad B| / sqrt(w) over the particles near it, kg^1/2 / m: see docs/notes/bodies.md. Of the last substep; FluidParams says m.
  float stiffness;
  float inverseXX, inverseYY, inverseZZ, inverseYZ, inverseZX, inverseXY;  // 1/(kg m^2), of the predicted pose, without locked rotations
  uint solid;
  float inertiaXX, inertiaYY, inertiaZZ, inertiaYZ, inertiaZX, inertiaXY;  // kg m^2, about the center of mass, in the solid's frame
  uint firstPoint;                         // of its ContactPointRecords, which follow one another
  uint mayTouch;                           // 1: its points were tested in the last substep, so that they may have slips
};
RILL_CONST uint kBodyQuads = 13u;  // of a BodyRecord, four words each
// A body that takes less than this share of a push gives way. What others push is bounded in speed: docs/notes/overlaps.md.
RILL_CONST float kFirmShare = 0.9f;

// A sphere on the surface of a body, whose contacts with walls and other solids are found; see engine/shape/contact_points.hpp.
struct ContactPointRecord {
  float x, y, z;   // m, center, in the solid's frame
  float radius;    // m
  uint body;
};

// What a contact point touches, and how far it has slipped there since it does, as in the discrete element method (Cundall and Strack
// 1979): so friction holds what stands on a slope, however many substeps that takes.
struct SlipRecord {
  uint partner;    // 1 and a solid's index, or kWallPartner and a side of the domain; 0: none
  float x, y, z;   // m, in the axes of the scene
  float limit;     // m, beyond which friction does not hold it
};
RILL_CONST uint kWallPartner = 0x10000u;

// Solids that a body may touch in a substep.
RILL_CONST uint kMaxTouched = 31u;
struct TouchedRecord {
  uint count;
  uint walls;      // 1: it may touch some
  uint solids[kMaxTouched];
};

// Bodies in the order in which they are found, as words: how many workgroups of points are to be tested, how many bodies are in contact,
// then two words for each body for the former (see pointWorkgroup), and one for each for the latter.
RILL_CONST uint kPointWorkgroups = 2u;  // of a body, at most: kMaxContactPoints (engine/shape/contact_points.hpp) over kFluidGroup
RILL_CONST uint kContactLists = 2u;     // words before the lists

// What a contact point may touch in a substep: a bit for each solid of its body's TouchedRecord, and this one for walls.
RILL_CONST uint kMayTouchWalls = 1u << kMaxTouched;

// A spring of the host that pulls a body in an advance; see rill::BodyPull.
struct PullRecord {
  uint body;
  float pointX, pointY, pointZ;     // m, from the center of mass, in the solid's frame
  float targetX, targetY, targetZ;  // m, relative to the fluid's origin
  float rate;                       // rad/s, angular frequency without damping
  float dampingRatio;
  float maxForce;                   // N
};
RILL_CONST uint kMaxPulls = 64u;

RILL_RECORDS_END
#endif
