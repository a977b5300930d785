#pragma once
// How many particles a state has, where shaders and dispatches read it.
#include "graph/shader_pass.hpp"
#include "rill/fluid.hpp"

namespace rill {

/// The particles of a state, for passes over all of them.
struct CountedParticles {
  BufferRef count;          ///< its first uint is their number; the host's may be above the capacity
  DispatchSize groups = 0;  ///< an invocation for each
};

/// FluidState::countBuffer; where a host gives none, a buffer that holds the capacity.
BufferRef particleCount(Graph& graph, const FluidState& fluid);

/// `pipeline`: of "render/particle_groups", whose pass sizes the dispatches; without a countBuffer they are over the capacity.
/// `groupSize`: invocations of a workgroup.
CountedParticles countParticles(Graph& graph, const FluidState& fluid, const ComputePipeline* pipeline, uint32_t groupSize);

}  // namespace rill
