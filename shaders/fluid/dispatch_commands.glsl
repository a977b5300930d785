// Enabling dispatch commands. Needs `params`, `sums`, `shapes`, and `control` and `commands` to write.
#ifndef RILL_DISPATCH_COMMANDS_GLSL
#define RILL_DISPATCH_COMMANDS_GLSL
#include "shared/dispatch.glsl"
// The starts whose commands run, a bit each, once the control block is settled. `parity`: of
// the substep whose density pass has just run; kNoSubstep, kNoBegin: none has.
uint startsOn(uint parity) {
  bool rebuilds = control.listState == kListNone || (control.listState == kListDue && control.timeLeft > 0.0);
  return 1u << kStartAlways | 1u << kStartFigures |
         uint(parity == kNoSubstep && control.timeLeft > 0.0) << kStartPredict |
         uint(control.running != 0u) << kStartDensity |
         uint(control.again != 0u) << kStartIterate |
         uint(parity == 0u) << kStartCorrect |
         uint(parity == 1u) << kStartCorrectOdd |
         uint(parity < kNoSubstep && control.noiseDamping > 0.0) << kStartNoiseDamping |
         uint(parity < kNoSubstep && control.diffusion > 0.0) << kStartDiffusion |
         uint(control.sleep == kFallingAsleep && parity == kNoSubstep) << kStartFallAsleep |
         uint(rebuilds) << kStartRebuild;
}

uvec3 groupsFor(uint particles, uint each) { return foldGroups(divideUp(particles, each)); }

bool someWalk(uint overflow) { return params.listCapacity == 0u || overflow > 0u; }

// `shapes` holds, for each command, its groups in x and y, or how many particles a group has, and what it
// is over and started by, as engine/fluid/dispatch_commands.hpp packs them; `commands` is what the device
// dispatches. Of the commands, every `lanes`-th from `lane` on.
void switchCommands(uint on, uint lane, uint lanes) {
  const uint whole = 1u << kStartRebuild | 1u << kStartFigures | 1u << kStartFallAsleep;  // also over particles in regions asleep
  bool walks = someWalk(sums.overflow);
  for (uint k = lane; k < params.commandCount; k += lanes) {
    uvec3 shape = uvec3(shapes[3u * k], shapes[3u * k + 1u], shapes[3u * k + 2u]);
    uint start = shape.z >> 4u, count = (whole >> start & 1u) != 0u ? control.count : control.solved;
    uvec3 groups = uvec3(shape.xy, 1u);
    switch (shape.z & 15u) {
      case kOverParticles: groups = groupsFor(max(count, 1u), shape.x); break;  // the first one starts sums anew
      case kOverChunk: groups = groupsFor(min(count, params.chunkParticles), shape.x); break;
      case kOverLists: groups = groupsFor(walks ? 0u : min(count, params.chunkParticles), shape.x); break;
      case kOverGrid: groups = groupsFor(walks ? min(count, params.chunkParticles) : 0u, shape.x); break;
      case kOverNearSolids: groups = groupsFor(sums.nearSolids, shape.x); break;
      case kOverNearLists: groups = groupsFor(walks ? 0u : sums.nearSolids, shape.x); break;
      case kOverNearGrid: groups = groupsFor(walks ? sums.nearSolids : 0u, shape.x); break;
      case kOverInReach: groups = groupsFor(sums.inReach, shape.x); break;
      case kOverNearMouths: groups = groupsFor(sums.nearMouths, shape.x); break;
    }
    if ((on >> start & 1u) == 0u) groups = uvec3(0u);
    commands[3u * k] = groups.x;
    commands[3u * k + 1u] = groups.y;
    commands[3u * k + 2u] = groups.z;
  }
}

// By all invocations of a workgroup.
void switchCommands(uint parity) { switchCommands(startsOn(parity), gl_LocalInvocationID.x, gl_WorkGroupSize.x); }
#endif
