#pragma once
// What the host knows of when a fluid may sleep: docs/notes/sleep.md.
#include "fluid/settings.hpp"

namespace rill {

/// Sets what shaders/fluid/sleep.glsl needs, behind the gravity schedule, if the scene asks for sleep. `room`: m, the longest extent of the
/// fluid's room. Call it after the schedule is set.
void addSleep(const Scene& scene, double room, FluidSetup& setup);

}  // namespace rill
