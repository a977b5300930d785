// Shared by the baselines' shaders and the host: particles in a box of cells as wide as the search radius.
#ifndef RILL_BENCH_CLOUD_H
#define RILL_BENCH_CLOUD_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN
RILL_CONST uint kCloudGroup = 64;

struct CloudPush {
  float radius;  // m
  uint cellsX, cellsY, cellsZ;
  uint count;
  uint first, last;  // range of candidates, all_pairs only
};
RILL_RECORDS_END
#endif
