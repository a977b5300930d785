#include "render/particle_count.hpp"

#include "sort/dispatches.hpp"

namespace rill {

BufferRef particleCount(Graph& graph, const FluidState& fluid) {
  if (fluid.countBuffer != BufferRef{}) return fluid.countBuffer;
  BufferRef count = graph.create("particle count", {4});
  addFill(graph, "particle count", {{&count, fluid.capacity}});
  return count;
}

CountedParticles countParticles(Graph& graph, const FluidState& fluid, const ComputePipeline* pipeline, uint32_t groupSize) {
  struct Push {
    uint32_t capacity, groupSize;
  };
  const BufferRef count = particleCount(graph, fluid);
  if (fluid.countBuffer == BufferRef{}) return {count, divideUp(fluid.capacity, groupSize)};
  BufferRef groups = graph.create("particle groups", {sizeof(VkDispatchIndirectCommand)});
  addDispatch(graph, "particle groups", pipeline, 1, Push{fluid.capacity, groupSize},
              {{"particle_count", count}, {"particle_groups", groups}});
  return {count, {groups, 0}};
}

}  // namespace rill
