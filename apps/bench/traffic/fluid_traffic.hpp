#pragma once
// What a fluid's advance makes a device read, write, dispatch and wait for, pass by pass.
#include <string>
#include <vector>

#include "bench/traffic/cost_model.hpp"
#include "bench/workbench.hpp"
#include "fluid/pass_table.hpp"
#include "rill/fluid.hpp"

namespace rill::bench {

/// The part of an advance that a pass belongs to.
using Section = PassSection;
std::string_view sectionName(Section section);

/// Totals over an advance of all passes of one name.
struct PassTraffic {
  std::string name;
  Section section = Section::Start;
  uint64_t recorded = 0, executed = 0;  ///< dispatches, fills and copies; executed: with at least one workgroup
  uint64_t barriers = 0;
  double readBytes = 0, writtenBytes = 0;  ///< of executed dispatches
  double gatheredBytes = 0;                ///< read through the lists, mostly from caches
  uint32_t serialCommands = 0;             ///< dispatch commands that one invocation writes, at most

  double bytes() const { return readBytes + writtenBytes; }
};

struct FluidTraffic {
  uint64_t particles = 0;
  double substeps = 0, recordedSubsteps = 0, builds = 0;  ///< of the advance
  double listEntries = 0;                                 ///< a particle, of those with a list
  std::vector<PassTraffic> passes;                        ///< in the order in which they first ran

  /// Sums over the passes of a section.
  PassTraffic total(Section section) const;
  /// A substep as recorded (its bytes as executed), per particle.
  double bytesPerParticleSubstep(Section section) const;
  /// The whole advance, recorded commands that had no effect included.
  DeviceWork advance() const;
};

/// Changes of the scene box-and-sphere that make it run every pass but those of sleeping fluid.
std::vector<Override> allPasses();

/// The work of a frame of `substeps` substeps of `particles` particles, by the traffic of another advance of the same scene.
DeviceWork frameWork(const FluidTraffic& traffic, double particles, double substeps);

/// Advances a fluid without counting, in as many pieces as it takes.
Expected<void> advanceFluid(Workbench& workbench, Fluid& fluid, double advance_s);

/// Advances `fluid` by `advance_s` on the workbench and counts. `substeps`: recorded at once, see FluidStep.
Expected<FluidTraffic> measureTraffic(Workbench& workbench, Fluid& fluid, double advance_s, uint32_t substeps);

}  // namespace rill::bench
