// What the baselines' shaders and their caller share: a cloud of particles in a box of cells that are as wide as the search radius.
#ifndef RILL_BENCH_CLOUD_H
#define RILL_BENCH_CLOUD_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN
RILL_CONST uint kCloudGroup = 64;

struct CloudPush {
  float radius;  // m
  uint cellsX, cellsY, cellsZ;
  uint count;
  uint first, last;  // the particles that all_pairs goes through
};
RILL_RECORDS_END
#endif
