#pragma once
// A fluid's state on the host. snapshot_checks.cpp: whether it fits a fluid; snapshot_edits.cpp: changes to it. No Vulkan.
#include <span>

#include "fluid/settings.hpp"
#include "rill/fluid.hpp"
#include "rill/snapshot.hpp"
#include "shape/pose.hpp"

namespace rill {

/// What a snapshot must fit.
struct SnapshotShape {
  uint32_t capacity = 0;  ///< particles at most
  uint32_t solidCount = 0, bodyCount = 0, contactPoints = 0;
  uint32_t listCapacity = 0;
  uint32_t emitterCount = 0;
  uint32_t fluids = 1;
  uint64_t flowWords = 0;                  ///< of FluidSnapshot::flows
  uint64_t regions = 0;                    ///< that fall asleep on their own
  uint64_t cells = 0;                      ///< of the grid
  uint32_t initialPressureIterations = 0;  ///< FluidParams::initialPressureIterations
  bool segments = false, tension = false, movingSolids = false;
};
SnapshotShape snapshotShape(const FluidSetup& setup);
/// Entries of FluidSnapshot::flows.
uint64_t flowWords(const FluidSetup& setup);

/// BadInput, naming the array, for lengths that do not fit and for indices out of range, which shaders would read by. Any float is valid.
Expected<void> checkSnapshot(const FluidSnapshot& snapshot, const SnapshotShape& shape);

/// Whether the snapshot has a list (or, where the fluid has none, a grid) that is not due to be built anew.
bool hasNeighbors(const FluidSnapshot& snapshot);

/// The neighbors are due to be found anew before the next substep: after a change of what is near whom.
void forgetNeighbors(FluidSnapshot& snapshot);
/// A fluid that sleeps, or regions of it, go on in substeps: after a change that it does not see.
void wake(FluidSnapshot& snapshot);
/// Particles that were not there before, with the next ids; `fluids`: empty in a scene with one. Neighbors are forgotten.
void append(FluidSnapshot& snapshot, std::span<const Float3> positions, std::span<const Float3> velocities,
            std::span<const uint8_t> fluids = {});
/// The solids `after` in place of `before`, of which those that both have are the same and keep their motion: solids are added or left
/// out at the end. `poses`: of those after, in the scene; bodies that go on keep theirs. Neighbors are forgotten.
void replaceSolids(FluidSnapshot& snapshot, std::span<const Solid> before, std::span<const Solid> after, std::span<const Pose> poses,
                   const Double3& origin);
/// The emitters of `after`, of which those of `before` come first and go on, in the same order. The others are closed until
/// FluidStep::emitters opens them. `before` and `after` differ in nothing else but the capacity. Neighbors are forgotten.
void addEmitters(FluidSnapshot& snapshot, const Scene& before, const Scene& after, const Double3& origin);
/// Gravity from the present instant on, m/s^2, where no schedule changes it.
void setGravity(FluidSnapshot& snapshot, const Double3& gravity);

/// Where the particles of each cell begin, one more at the end: what the sort gave.
void cellStarts(std::span<const uint32_t> cell, std::span<uint32_t> start);

}  // namespace rill
