// What tests/gpu/solid_test.cpp asks of the shaders' geometry, and what they answer.
#include "shared/solid_records.h"
RILL_RECORDS_BEGIN

struct SolidQuery {
  uint solid;
  float time, ahead;           // s
  float x, y, z;               // m
  float alongX, alongY, alongZ;
};

struct SolidAnswer {
  PoseRecord now, later;
  float distance, normalX, normalY, normalZ;  // at the point, in the scene's frame
  float velocityX, velocityY, velocityZ;      // of the solid there
  float entry, entryX, entryY, entryZ;        // of the ray, in lengths of `along`, and the normal
};

RILL_RECORDS_END
