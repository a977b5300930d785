// Push constants of the fluid's passes.
#ifndef RILL_PUSH_RECORDS_H
#define RILL_PUSH_RECORDS_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

struct BeginPush {
  float advance;       // s
  float drivenSpeed;   // m/s, the fastest driven solid of the advance
  uint queued;         // 1: only if the last advance has no time left; else that one continues
  uint pulls;          // as FluidControl has it
  uint drives;         // 1: a driven solid moves in the advance, or an emitter has changed
  uint mouths;         // 1: an emitter has changed
};

struct DensityPush {
  uint first, last;    // as in ChunkPush
  uint iteration;      // as in ControlPush
  uint parity;
  uint blockStart;
};

struct ControlPush {
  uint iteration;      // 0 is the first
  uint parity;         // of the recorded substep
  uint blockStart;     // the substep is recorded as the first of its block
};

struct DisplacePush {
  uint begins;         // 1: the first iteration of a substep
  uint measures;       // 1: for figures
};

struct MouthDensityPush {
  uint predicted;      // 1: the time of the positions is yet to come
};

struct LoadPush {
  uint ends;           // 1: the last iteration of a substep
};

struct ContactPush {
  uint iteration;      // 0 is the first
};

struct ChunkPush {
  uint first;          // particle that the list buffer starts with
  uint last;           // one past its last particle
  uint iteration;      // 0 is the first
};

RILL_RECORDS_END
#endif
