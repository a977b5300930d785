// Shared by begin.comp, finish_rebuild.comp and control.comp: enabling dispatch commands, simulated
// time, the gravity schedule.
#ifndef RILL_DISPATCH_COMMANDS_GLSL
#define RILL_DISPATCH_COMMANDS_GLSL
// `shapes` holds the group counts of each command, `commands` what the device dispatches.
void switchCommand(uint k, bool on, FluidSums s) {
  uvec3 groups = uvec3(shapes[3u * k], shapes[3u * k + 1u], shapes[3u * k + 2u]);
  if (k >= kCommandPlane && k <= kCommandCornerAgain) {
    uint near = k == kCommandPlane || k == kCommandMeasurePlane || k == kCommandPlaneAgain ? s.planeCount : s.cornerCount;
    uint needed = (near + kFluidGroup - 1u) / kFluidGroup;
    groups = uvec3(min(needed, 65535u), needed == 0u ? 0u : (needed + 65534u) / 65535u, 1u);
  }
  if (!on) groups = uvec3(0u);
  commands[3u * k] = groups.x;
  commands[3u * k + 1u] = groups.y;
  commands[3u * k + 2u] = groups.z;
}

// Which commands run, once the control block is settled. `parity`: of the substep whose density
// pass has just run; 2: none has.
bool shouldRun(uint k, FluidControl c, uint parity, FluidSums s) {
  bool walks = k >= kCommandWalks && k < kCommandSort;
  if (walks) k = k - kCommandWalks + kCommandDensity;
  bool gathers = k >= kCommandDensity && k <= kCommandNoiseDamping;
  if (gathers && walks != (params.listCapacity == 0u || s.overflow > 0u)) return false;
  bool rebuild = c.listState == kListNone || (c.listState == kListDue && c.timeLeft > 0.0);
  if (k == kCommandDensity || k == kCommandPose || k == kCommandPlane || k == kCommandCorner) return c.running != 0u;
  if (k == kCommandCorrect || k == kCommandCollide) return parity == 0u;
  if (k == kCommandCorrect + 1u || k == kCommandCollide + 1u) return parity == 1u;
  if (k == kCommandNoiseDamping) return parity != 2u && c.noiseDamping > 0.0;
  if (k == kCommandIterate || k == kCommandPlaneAgain || k == kCommandCornerAgain) return c.again != 0u;
  if (k == kCommandMeasurePlane || k == kCommandMeasureCorner) return true;
  if (k == kCommandPredict) return parity == 2u && c.timeLeft > 0.0;
  return rebuild;
}

// In one invocation: a barrier costs lavapipe more than the loop.
void switchCommands(uint count, FluidControl c, uint parity, FluidSums s) {
  for (uint k = 0u; k < count; ++k) switchCommand(k, shouldRun(k, c, parity, s), s);
}

// Adds to the two-float sum (Knuth's TwoSum).
void addTime(inout FluidControl c, float step) {
  precise float sum = c.timeHigh + (step + c.timeLow);
  precise float rest = (c.timeHigh - sum) + (step + c.timeLow);
  c.timeHigh = sum;
  c.timeLow = rest;
}

// Gravity from the last schedule entry up to the present time; entry 0 is the scene's own, at time 0.
void gravityAt(inout FluidControl c) {
  for (uint n = 0u; n < params.gravityChanges && c.gravityIndex < params.gravityChanges; ++n) {
    vec4 change = gravityChanges[c.gravityIndex];
    if (change.w > c.timeHigh + 1.0e-7) break;
    c.gravityX = change.x;
    c.gravityY = change.y;
    c.gravityZ = change.z;
    c.gravityIndex += 1u;
  }
}
#endif
