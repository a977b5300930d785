// Shape, pose and motion of a solid on the device. Their geometry is in shape.glsl, pose.glsl and keyframes.glsl here, in
// engine/shape on the host.
#ifndef RILL_SOLID_RECORDS_H
#define RILL_SOLID_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

RILL_CONST uint kShapeBox = 0u, kShapeSphere = 1u, kShapeMesh = 2u;

struct ShapeRecord {
  float halfX, halfY, halfZ;        // m, half extents; of a sphere its radius
  uint kind;                        // kShapeBox, kShapeSphere or kShapeMesh
  float middleX, middleY, middleZ;  // m, of the bounds: 0 but for a mesh
  uint field;                       // mesh: where its field begins among the words (mesh_field.h)
};

struct PoseRecord {
  float centerX, centerY, centerZ;                   // m, relative to the owner's origin
  float rotationX, rotationY, rotationZ, rotationW;  // unit quaternion from the solid's frame to the scene's
  float velocityX, velocityY, velocityZ;             // m/s, of the center
  float angularX, angularY, angularZ;                // rad/s, angular velocity in the scene's frame
};

// Displacement from the initial pose at a time; of a driven solid its pose.
struct KeyframeRecord {
  float x, y, z;                                     // m
  float at;                                          // s
  float rotationX, rotationY, rotationZ, rotationW;  // unit quaternion, about the center
  float turnX, turnY, turnZ;                         // rad, rotation vector to the next keyframe in the scene's frame
  float unused;
};

// A solid of the fluid at the end of the present substep. Read four words at a time (fluid/solid_array.glsl).
struct SolidRecord {
  PoseRecord pose;
  ShapeRecord shape;
  float friction, restitution;
  float radius;                // m, of the sphere around the center that holds the shape
  uint body;                   // index of its BodyRecord, or kNoBody
  uint noSlip;                 // 1: viscous fluid sticks to it
  uint tableOffset;            // sphere: entries into the table buffer
  uint tableNodes;
  float tableFirst;            // sphere: signed distance of the table's first node, m
  uint firstKey, keyCount;     // entries of the keyframe buffer
  uint driven;                 // 1: two keyframes, its poses at the begin and at the end of the advance, with seconds since its begin
  PoseRecord base;             // before any motion
  uint holdsAwake;             // 1: fluid near it does not fall asleep on its own
  float unused[2];
};
RILL_CONST uint kSolidQuads = 12u;  // of a SolidRecord, four words each

RILL_CONST uint kNoBody = 0xffffffffu;

// An entry of the array nearSolids, in NEAR_QUADS times four words: a particle, then the solids near it by increasing index, two a word,
// the first in the low half, and kNoSolid after the last. kAllSolids as the first: any solid may be near.
RILL_CONST uint kMaxSolids = 4096u, kMaxNearQuads = 4u, kListedSolids = 8u * kMaxNearQuads - 2u, kNoSolid = 0xffffu, kAllSolids = 0xfffeu;

RILL_RECORDS_END
#endif
