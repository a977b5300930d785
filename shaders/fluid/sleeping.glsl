// Whether particle i sleeps: substeps do not move it. Needs listHeadAt().
#ifndef RILL_SLEEPING_GLSL
#define RILL_SLEEPING_GLSL
#include "shared/neighbor_list.h"
bool isAsleep(uint i) { return REGIONS && (listHeadAt(i) & kAsleepBit) != 0u; }
#endif
