#pragma once
#include <cstdint>
#include <vector>

#include "rill/fluid.hpp"
#include "rill/graph.hpp"
#include "rill/vectors.hpp"

namespace rill::offline {

/// Particles in the order of the device.
struct Readout {
  std::vector<Float3> positions;         ///< m, relative to FluidState::origin
  std::vector<Float3> velocities;        ///< m/s
  std::vector<float> relativeDensities;  ///< density over rest density
  std::vector<uint32_t> ids;
  std::vector<uint8_t> fluids;         ///< index among resolvedFluids()
  std::vector<Float4> concentrations;  ///< as FluidState::concentration; empty: nothing diffuses
};

/// Read-backs of a Readout.
struct ReadoutTickets {
  Ticket position, velocity, id, concentration, particles;
  bool mixes = false;  ///< there are concentrations
  uint32_t capacity = 0;
};

/// Adds the read-backs of a state to a graph; none without particles.
ReadoutTickets readout(Graph& graph, const FluidState& state);
/// The particles that were read back. The frame must have completed.
Readout collect(const Graph& graph, const ReadoutTickets& tickets);
/// Without the inactive ones, which have left the fluid and keep their entries until the next sort.
Readout activeOnly(const Readout& all);

}  // namespace rill::offline
