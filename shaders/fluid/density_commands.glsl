// MERGED: commands of the density pass, which accounts for its substep itself. It runs in every substep that is recorded,
// over the particles there are, and finds out on its own whether there is something to do. Its commands change with the list
// alone, since it may not write them while it runs. Needs dispatch_commands.glsl and `densityCommands` to write.
#ifndef RILL_DENSITY_COMMANDS_GLSL
#define RILL_DENSITY_COMMANDS_GLSL
void setDensityCommands() {
  bool walks = someWalk(sums.overflow);
  uvec3 groups = groupsFor(max(min(control.solved, params.chunkParticles), 1u), kFluidGroup);
  // Of the variant that reads lists alone, and of the one that walks the grid.
  for (uint k = gl_LocalInvocationID.x; k < 2u; k += gl_WorkGroupSize.x) {
    uvec3 own = walks == (k == 1u) ? groups : uvec3(0u);
    densityCommands[3u * k] = own.x;
    densityCommands[3u * k + 1u] = own.y;
    densityCommands[3u * k + 2u] = own.z;
  }
}
#endif
