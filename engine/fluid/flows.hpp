#pragma once
// Emitters and drains as the device's records. See docs/notes/flows.md.
#include <array>
#include <vector>

#include "fluid/settings.hpp"
#include "rill/scene.hpp"
#include "shared/flow_records.h"

namespace rill {

/// The particles of a layer that leaves a mouth. Layers that follow each other at `thickness` have rest density.
struct MouthLattice {
  Double3 center = {0, 0, 0};                                      ///< m
  Double3 normal = {0, 0, 0}, across = {0, 0, 0}, up = {0, 0, 0};  ///< unit vectors; across = normal x up
  std::pair<double, double> half = {0, 0};        ///< m, half the mouth's size along `across` and `up`; of a disc its radius
  std::vector<std::array<float, 2>> points = {};  ///< m, along `across` and `up` from the center; at least one
  double area = 0;                                ///< m^2, of the mouth
  double thickness = 0;                           ///< m, of a layer
  Double3 arm = {0, 0, 0};                        ///< m, from what its motion turns it about to the center
  size_t shared = 0;                              ///< points of a mesh that were left out, since several triangles have them
};
MouthLattice mouthLattice(const Mouth& mouth, double spacing);

/// The records of a scene's emitters and drains at its start. BadInput for a mouth with too many particles, or of a speed beyond any step.
/// Warns of speeds that the steps cannot follow.
Expected<void> addFlows(const Scene& scene, const Double3& origin, FluidSetup& setup);

/// m/s, of the fluid in the mouths, their motion included.
double fastestEmitter(const Scene& scene);

/// What a host may change of an emitter while it runs: the words of its record before `from`. `center`: m, relative to the particles'
/// origin. The axes are unit vectors.
void place(EmitterRecord& record, const Double3& center);
void setAxes(EmitterRecord& record, const Double3& normal, const Double3& across, const Double3& up);
void setFlow(EmitterRecord& record, const MouthSize& size, double flow);

/// The ledger of a fluid that starts with `particles`, of which some are inactive.
FlowRecord firstLedger(uint32_t particles, uint32_t inactive);

}  // namespace rill
