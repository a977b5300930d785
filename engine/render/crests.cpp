#include "render/crests.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gpu/module_pipelines.hpp"
#include "sort/dispatches.hpp"

namespace rill {

Expected<CrestDepths> CrestDepths::create(Device& device) {
  CrestDepths out;
  ModulePipelines pipelines(device);
  out.depths_ = pipelines.make("render/crest_depths");
  out.heights_ = pipelines.make("render/crest_heights");
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

uint32_t CrestDepths::side(uint32_t capacity) {
  return std::bit_ceil(std::clamp(static_cast<uint32_t>(std::sqrt(double(capacity))), 64u, 2048u));
}

BufferRef CrestDepths::addTo(Graph& graph, const FluidState& fluid, const Float4& toSun, const CountedParticles& particles) const {
  struct Push {
    float x, y, z, spacing;
    uint32_t capacity, side;
  };
  const uint32_t cells = side(fluid.capacity);
  BufferRef crests = graph.create("fluid crests", {uint64_t{cells} * cells * 8});
  addFill(graph, "fluid crests clear", {{&crests, 0}});
  const Push push{toSun.x, toSun.y, toSun.z, fluid.spacing, fluid.capacity, cells};
  addDispatch(graph, "fluid crests", depths_, particles.groups, push,
              {{"position", fluid.position}, {"particle_count", particles.count}, {"crests", crests}});
  BufferRef heights = graph.create("fluid crest heights", {uint64_t{cells} * cells * 8});
  addDispatch(graph, "fluid crest heights", heights_, divideUp(uint64_t{cells} * cells, 64), push,
              {{"crests", std::as_const(crests)}, {"heights", heights}});
  return heights;
}

}  // namespace rill
