#pragma once
// How many particles a state has, where shaders read it.
#include "graph/shader_pass.hpp"
#include "rill/fluid.hpp"

namespace rill {

/// FluidState::countBuffer; where a host gives none, a buffer that holds the capacity.
inline BufferRef particleCount(Graph& graph, const FluidState& fluid) {
  if (fluid.countBuffer != BufferRef{}) return fluid.countBuffer;
  BufferRef count = graph.create("particle count", {4});
  addFill(graph, "particle count", {{&count, fluid.capacity}});
  return count;
}

}  // namespace rill
