// Walks the grid around a cluster. Before it includes this the shader binds `sums` and makes
// cellStartAt(), the starts of the cells that the particles were sorted by, and defines:
//   void takeTurn(bool mine)               the lanes whose neighbors come next: they are in one row of cells
//   void candidates(uint first, uint end)  particles of the sorted arrays, 0 to kWindow of them; all lanes of the subgroup are here
#ifndef RILL_WALK_GLSL
#define RILL_WALK_GLSL
#include "fluid/cell_rows.glsl"
#include "shared/loops.glsl"

// Lanes go through rows of cells together. Where a cluster holds particles from anywhere (SCATTERED) only those of one cell do: what a
// particle visits, and in which order, must not depend on the others.
#ifdef SCATTERED
#define TURN vec3
#define turnOf(low) floor(low)
#define rowOf(turn) (turn).yz
#else
#define TURN vec2
#define turnOf(low) floor((low).yz)
#define rowOf(turn) (turn)
#endif

uint walked = 0u;  // candidates, in all walks of the invocation

// `boxLow` to `boxHigh`: a box in one cell, in cells, that held the lane's particle when the cells
// were sorted; `waits`: whether the lane still has to visit its neighbors. `reach` (m): at most a
// cell's edge in y.
void walkGrid(vec3 boxLow, vec3 boxHigh, bool waits, float reach) {
  TURN own = turnOf(boxLow);
  uint leader = clusterMin(waits ? clusterLane : CLUSTER), turns = 0u;
  LOOP_WHILE (ANY_LANE(leader < CLUSTER) && turns < CLUSTER) {
    TURN next = SPREAD(own, leader & (CLUSTER - 1u));
    vec2 row = rowOf(next);
    bool mine = waits && (own == next || clusterLane == leader);  // the leader at least, whatever NaN compares like
    if (mine) waits = false;
    vec3 low = clusterMin(mine ? boxLow : vec3(2.0e9)), high = clusterMax(mine ? boxHigh : vec3(-2.0e9));
    takeTurn(mine);

    // Nine rows of cells, in two parts where the grid may wrap: every lane looks one up, then all
    // go through them together. A row's parts follow each other, so that the order of a particle's
    // neighbors does not depend on the other particles of its cluster.
    vec4 gaps = vec4(low.yz - row, row + 1.0 - high.yz) / inverseCell.yzyz;
    float first = floor(low.x) - float(kCellsPerReach) - 1.0, last = floor(high.x) + float(kCellsPerReach) + 1.0;
    uint parts = wrapped(vec3(first, row)).x + (last - first) >= gridSize.x ? 2u : 1u;
    uint rows = leader < CLUSTER ? 9u * parts : 0u, base = 0u;
    LOOP_WHILE (ANY_LANE(base < rows)) {
      uint at = base + clusterLane, begin = 0u, end = 0u;
      if (at < rows) rowRange(low.x, high.x, row, gaps, reach, at / parts, at % parts, begin, end);
      uint lane = 0u;
      LOOP_WHILE (lane < CLUSTER && ANY_LANE(base + lane < rows)) {
        uint from = SPREAD(begin, lane), to = max(from, SPREAD(end, lane));
        if (walked >= kWalkBound) to = from;
        LOOP_WHILE (ANY_LANE(from < to)) {
          uint end_of_window = min(to, from + kWindow);
          candidates(from, end_of_window);
          walked += from < to ? kWindow : 0u;
          from = walked < kWalkBound ? end_of_window : to;
        } LOOP_END(ANY_LANE(from < to));
        ++lane;
      } LOOP_END(lane < CLUSTER && ANY_LANE(base + lane < rows));
      base += CLUSTER;
    } LOOP_END(ANY_LANE(base < rows));
    leader = clusterMin(waits ? clusterLane : CLUSTER);
    ++turns;
  } LOOP_END(ANY_LANE(leader < CLUSTER) && turns < CLUSTER);
  if (walked >= kWalkBound && clusterLane == 0u) atomicAdd(sums.boundHits, 1u);
}
#endif
