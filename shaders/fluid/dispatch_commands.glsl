// Shared by begin.comp, finish_rebuild.comp and control.comp: enabling dispatch commands.
#ifndef RILL_DISPATCH_COMMANDS_GLSL
#define RILL_DISPATCH_COMMANDS_GLSL
// Whether a command that is started by `start` runs, once the control block is settled. `parity`: of
// the substep whose density pass has just run; kNoSubstep: none has.
bool isStarted(uint start, FluidControl c, uint parity) {
  switch (start) {
    case kStartPredict: return parity == kNoSubstep && c.timeLeft > 0.0;
    case kStartDensity: return c.running != 0u;
    case kStartIterate: return c.again != 0u;
    case kStartCorrect: return parity == 0u;
    case kStartCorrectOdd: return parity == 1u;
    case kStartNoiseDamping: return parity != kNoSubstep && c.noiseDamping > 0.0;
    case kStartRebuild: return c.listState == kListNone || (c.listState == kListDue && c.timeLeft > 0.0);
  }
  return true;
}

uvec3 groupsFor(uint particles, uint each) {
  uint needed = (particles + each - 1u) / each;
  return uvec3(min(needed, 65535u), needed == 0u ? 0u : (needed + 65534u) / 65535u, 1u);
}

// `shapes` holds, for each command, its groups in x and y, or how many particles a group has, and what it
// is over and started by, as engine/fluid/dispatch_commands.hpp packs them; `commands` is what the device
// dispatches.
void switchCommand(uint k, FluidControl c, uint parity, FluidSums s) {
  uvec3 shape = uvec3(shapes[3u * k], shapes[3u * k + 1u], shapes[3u * k + 2u]);
  uint over = shape.z & 15u;
  bool on = isStarted(shape.z >> 4u, c, parity);
  bool walks = params.listCapacity == 0u || s.overflow > 0u;
  uvec3 groups = uvec3(shape.xy, 1u);
  switch (over) {
    case kOverParticles: groups = groupsFor(max(c.count, 1u), shape.x); break;  // the first one starts sums anew
    case kOverChunk: groups = groupsFor(min(c.count, params.chunkParticles), shape.x); break;
    case kOverLists: groups = groupsFor(walks ? 0u : min(c.count, params.chunkParticles), shape.x); break;
    case kOverGrid: groups = groupsFor(walks ? min(c.count, params.chunkParticles) : 0u, shape.x); break;
    case kOverPlane: groups = groupsFor(s.planeCount, shape.x); break;
    case kOverCorner: groups = groupsFor(s.cornerCount, shape.x); break;
  }
  if (!on) groups = uvec3(0u);
  commands[3u * k] = groups.x;
  commands[3u * k + 1u] = groups.y;
  commands[3u * k + 2u] = groups.z;
}

// In one invocation: a barrier costs lavapipe more than the loop.
void switchCommands(FluidControl c, uint parity, FluidSums s) {
  for (uint k = 0u; k < params.commandCount; ++k) switchCommand(k, c, parity, s);
}
#endif
