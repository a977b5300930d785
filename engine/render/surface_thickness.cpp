// The thickness of the fluid along rays, as passes.
#include "gpu/module_pipelines.hpp"
#include "graph/shader_pass.hpp"
#include "render/surface.hpp"

namespace rill {

using namespace surface;

namespace {

constexpr float kThicknessRadius = 1.2f;       // spacings: discs that overlap enough for a smooth sum
constexpr float kThicknessUnit = 1.0f / 1024;  // spacings

}  // namespace

SurfacePush SurfaceStage::thicknessPush(SurfacePush camera, const FluidState& fluid, uint32_t step) {
  camera.spacing = fluid.spacing;
  camera.radius = kThicknessRadius * fluid.spacing;
  camera.unit = kThicknessUnit * fluid.spacing;
  camera.count = fluid.capacity;
  camera.step = step;
  camera.margin = 0;
  return camera;
}

Expected<void> SurfaceStage::setFluids(Device& device, uint32_t count) {
  ModulePipelines pipelines(device);
  const ComputePipeline* behindScene = pipelines.make("render/surface_thickness", false, {{"FLUIDS", count}});
  const ComputePipeline* free = pipelines.make("render/surface_thickness_no_scene", false, {{"FLUIDS", count}});
  if (auto made = pipelines.result(); !made) return made;
  fluidThickness_ = behindScene;
  fluidThicknessNoScene_ = free;
  fluids_ = count;
  return {};
}

BufferRef SurfaceStage::addThickness(Graph& graph, const ThicknessNames& names, const FluidState& fluid, const SurfacePush& push,
                                     BufferRef sceneDepth, SurfaceBuffers* surface, Of of) const {
  const bool each = of == Of::EachFluid && fluids_ > 1, hidden = sceneDepth != BufferRef{};
  const uint32_t grids = !each ? 1 : hidden ? 2 * fluids_ : fluids_;
  BufferRef own;
  if (!surface) own = graph.create(names.counters, {kSurfaceCounterWords * 4});
  BufferRef thickness = graph.create(names.pass, {gridCells(push.width, push.height, push.step) * 4 * grids});
  addFill(graph, names.clear, {{&thickness, 0}, {surface ? nullptr : &own, 0}});
  if (fluid.capacity == 0) return thickness;
  const CountedParticles particles = surface ? surface->particles : countParticles(graph, fluid, particleGroups_, kSurfaceGroup);
  BufferRef& counters = surface ? surface->counters : own;
  const ComputePipeline* pipeline = each ? (hidden ? fluidThickness_ : fluidThicknessNoScene_) : hidden ? thickness_ : thicknessNoScene_;
  addDispatch(graph, names.pass, pipeline, particles.groups, push,
              {{"position", fluid.position},
               {"particle_count", particles.count},
               {"thickness", thickness},
               {"counters", counters},
               {"scene_depth", sceneDepth}});
  return thickness;
}

}  // namespace rill
