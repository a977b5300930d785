// The thickness of the fluid along rays, as passes.
#include <cassert>
#include <utility>
#include <vector>

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/shader_pass.hpp"
#include "render/mixture.hpp"
#include "render/surface.hpp"

namespace rill {

using namespace surface;

namespace {

constexpr float kThicknessRadius = 1.2f;       // spacings: discs that overlap enough for a smooth sum
constexpr float kThicknessUnit = 1.0f / 1024;  // spacings

struct BackPush {
  SurfacePush view;
  uint32_t surfaceGrid = 0;
};
static_assert(sizeof(BackPush) <= 128);

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

Expected<void> SurfaceStage::setFluids(Device& device, std::span<const FluidBody> fluids) {
  const auto count = static_cast<uint32_t>(fluids.size());
  const bool texels = !storageReads_ && usesTexelReads(device);
  ModulePipelines pipelines(device);
  std::vector<bool> diffuses;
  for (const FluidBody& fluid : fluids) diffuses.push_back(fluid.diffuses);
  const MixtureConstants m = mixtureConstants(diffuses);
  const ComputePipeline *mixed = nullptr, *mixedFree = nullptr;
  if (m.diffusing[0] != kNoFluid)
    for (const auto& [pipeline, name] :
         {std::pair{&mixed, "render/surface_thickness_mixed"}, {&mixedFree, "render/surface_thickness_mixed_no_scene"}})
      *pipeline = pipelines.make(name, texels,
                                 {{"FLUIDS", count},
                                  {"DIFFUSING_0", m.diffusing[0]},
                                  {"DIFFUSING_1", m.diffusing[1]},
                                  {"DIFFUSING_2", m.diffusing[2]},
                                  {"DIFFUSING_3", m.diffusing[3]},
                                  {"CARRIER", m.carrier}});
  const ComputePipeline* behindScene = pipelines.make("render/surface_thickness", texels, {{"FLUIDS", count}});
  const ComputePipeline* free = pipelines.make("render/surface_thickness_no_scene", false, {{"FLUIDS", count}});
  const ComputePipeline* back = pipelines.make("render/fluid_back", texels, {{"FLUIDS", count}});
  if (auto made = pipelines.result(); !made) return made;
  fluidBack_ = back;
  fluidThickness_ = behindScene;
  fluidThicknessNoScene_ = free;
  mixedThickness_ = mixed;
  mixedThicknessNoScene_ = mixedFree;
  fluids_ = count;
  return {};
}

BufferRef SurfaceStage::addThickness(Graph& graph, const ThicknessNames& names, const FluidState& fluid, const SurfacePush& push,
                                     BufferRef sceneDepth, SurfaceBuffers* surface, Of of) const {
  assert(fluid.capacity > 0);
  const bool each = of == Of::EachFluid && fluids_ > 1, hidden = sceneDepth != BufferRef{};
  const uint32_t grids = (!each ? 1 : hidden ? 2 * fluids_ : fluids_) + (hidden ? 1 : 0);
  BufferRef own;
  if (!surface) own = graph.create(names.counters, {kSurfaceCounterWords * 4});
  BufferRef thickness = graph.create(names.pass, {gridCells(push.width, push.height, push.step) * 4 * grids});
  addFill(graph, names.clear, {{&thickness, 0}, {surface ? nullptr : &own, 0}});
  const CountedParticles particles = surface ? surface->particles : countParticles(graph, fluid, particleGroups_, kSurfaceGroup);
  BufferRef& counters = surface ? surface->counters : own;
  const bool mixed = each && mixedThickness_ && fluid.concentration != BufferRef{};
  const ComputePipeline* pipeline = mixed    ? (hidden ? mixedThickness_ : mixedThicknessNoScene_)
                                    : each   ? (hidden ? fluidThickness_ : fluidThicknessNoScene_)
                                    : hidden ? thickness_
                                             : thicknessNoScene_;
  addDispatch(graph, names.pass, pipeline, particles.groups, push,
              {{"position", fluid.position},
               {"particle_count", particles.count},
               {"thickness", thickness},
               {"counters", counters},
               {"concentration", fluid.concentration},
               {"scene_depth", sceneDepth}});
  return thickness;
}

BufferRef SurfaceStage::addShadow(Graph& graph, const SurfacePush& light, BufferRef thickness) const {
  const uint32_t width = light.width + 2 * kShadowBorder, height = light.height + 2 * kShadowBorder;
  BufferRef shadow = graph.create("fluid shadow blurred", {uint64_t{width} * height * fluids_ * 4});
  if (light.count == 0) {
    addFill(graph, kFluidShadow.clear, {{&shadow, 0}});
    graph.skipped("fluid shadow blur", "there are no particles");
    return shadow;
  }
  const Groups groups{static_cast<uint32_t>(divideUp(width, kSurfaceTile)), static_cast<uint32_t>(divideUp(height, kSurfaceTile)), fluids_};
  addDispatch(graph, "fluid shadow blur", shadow_, groups, FluidShadowPush{light.width, light.height, light.unit},
              {{"thickness", std::as_const(thickness)}, {"fluid_shadow", shadow}});
  return shadow;
}

BufferRef SurfaceStage::addBack(Graph& graph, const SurfaceBuffers& surface, const SurfacePush& push, BufferRef thickness,
                                BufferRef sceneDepth, Of of) const {
  const uint64_t cells = gridCells(push.width, push.height, push.step);
  BufferRef back = graph.create("fluid back", {cells * 8});
  addDispatch(graph, "fluid back", of == Of::EachFluid && fluids_ > 1 ? fluidBack_ : back_, divideUp(cells, kSurfaceGroup),
              BackPush{push, surface.push.step | surface.push.margin << 16},
              {{"thickness", thickness}, {"scene_depth", sceneDepth}, {"samples", surface.samples}, {"back", back}});
  return back;
}

}  // namespace rill
