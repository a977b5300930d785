#include "views/motion.hpp"

#include "gpu/module_pipelines.hpp"
#include "graph/shader_pass.hpp"
#include "shared/solid_records.h"
#include "sort/dispatches.hpp"

namespace rill {
namespace {

constexpr uint32_t kMotionGroup = 64;

struct MotionPush {
  uint32_t count;
  float seconds;
};

}  // namespace

Expected<Motion> Motion::create(Device& device) {
  Motion out;
  ModulePipelines pipelines(device);
  out.particles_ = pipelines.make("views/motion_particles");
  out.solids_ = pipelines.make("views/motion_solids");
  if (auto made = pipelines.result(); !made) return made.error();
  return out;
}

BufferRef Motion::moved(Graph& graph, std::string_view name, BufferRef position, BufferRef velocity, uint32_t count, double seconds) const {
  BufferRef out = graph.create(name, {uint64_t{count} * sizeof(Float4)});
  addDispatch(graph, name, particles_, divideUp(count, kMotionGroup), MotionPush{count, static_cast<float>(seconds)},
              {{"position", std::as_const(position)}, {"velocity", std::as_const(velocity)}, {"moved", out}});
  return out;
}

FluidState Motion::addTo(Graph& graph, FluidState fluid, uint32_t solids, double seconds) const {
  if (fluid.capacity > 0) fluid.position = moved(graph, "motion particles", fluid.position, fluid.velocity, fluid.capacity, seconds);
  if (solids == 0 || fluid.solids == BufferRef{}) return fluid;
  BufferRef out = graph.create("motion solids", {uint64_t{solids} * sizeof(SolidRecord)});
  addDispatch(graph, "motion solids", solids_, divideUp(solids, kMotionGroup), MotionPush{solids, static_cast<float>(seconds)},
              {{"fluidSolids", std::as_const(fluid.solids)}, {"movedSolids", out}});
  fluid.solids = out;
  return fluid;
}

WhitewaterState Motion::addTo(Graph& graph, WhitewaterState white, double seconds) const {
  if (white.room > 0) white.place = moved(graph, "motion whitewater", white.place, white.motion, white.room, seconds);
  return white;
}

}  // namespace rill
