#pragma once
#include <cstdint>
#include <vector>

#include "rill/float3.hpp"
#include "rill/fluid.hpp"
#include "rill/graph.hpp"

namespace rill::offline {

/// The particles of an instant as the device holds them.
struct Readout {
  std::vector<Float3> positions;         ///< m, relative to FluidState::origin
  std::vector<Float3> velocities;        ///< m/s
  std::vector<float> relativeDensities;  ///< density over rest density
  std::vector<uint32_t> ids;
};

struct ReadoutTickets {
  Ticket position, velocity, id;
  uint32_t count = 0;
};

/// Declares the read-backs of a state; none where there is no particle.
ReadoutTickets readout(Graph& graph, const FluidState& state);
/// What they brought, once the graph's frame has completed.
Readout collect(const Graph& graph, const ReadoutTickets& tickets);

}  // namespace rill::offline
