#pragma once
// What the host knows of when a fluid may sleep: docs/notes/sleep.md.
#include <cstdint>

#include "fluid/settings.hpp"
#include "shared/region_records.h"

namespace rill {

constexpr size_t kRegionWords = sizeof(RegionRecord) / 4;  ///< a region, of FluidSnapshot::regions

/// Sets what shaders/fluid/sleep.glsl needs, behind the gravity schedule, if the scene asks for sleep. `room`: m, the longest extent of the
/// fluid's room. Call it after the schedule is set.
void addSleep(const Scene& scene, double room, FluidSetup& setup);

/// What the grid has to cover: the room, m, and where regions fall asleep on their own as much more that opposite sides of it are not
/// beside each other on the wrapped grid.
Double3 extentWithGap(const Double3& room, const FluidSetup& setup);

/// Divides the grid into regions that fall asleep on their own, if the fluid may sleep and has room for it. Call it after the grid is set.
void addRegions(const Double3& room, FluidSetup& setup);

}  // namespace rill
