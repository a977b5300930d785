#include "rill/fluid_renderer.hpp"

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/graph_impl.hpp"
#include "graph/shader_pass.hpp"
#include "render/check_input.hpp"
#include "render/fluid_renderer_impl.hpp"
#include "render/view_push.hpp"
#include "sort/dispatches.hpp"

namespace rill {

using namespace surface;

namespace {

/// Reports a failed check from compile().
bool accepted(Graph& graph, const Expected<void>& check) {
  if (!check) implOf(graph).fail(check.error().message);
  return bool(check);
}

}  // namespace

Expected<void> FluidRendererImpl::create(Device& host, const TargetFormats& targets) {
  if (auto ok = checkFormats(targets); !ok) return ok;
  device = &implOf(host);
  formats = targets;
  auto stage = SurfaceStage::create(host);
  if (!stage) return stage.error();
  surface = *stage;
  auto depths = CrestDepths::create(host);
  if (!depths) return depths.error();
  crests = *depths;
  auto mean = MeanNormals::create(host);
  if (!mean) return mean.error();
  meanNormals = *mean;
  ModulePipelines pipelines(host);
  scene = pipelines.make("render/surface_scene");
  for (const bool depth : {false, true}) data[depth] = pipelines.make("render/surface_data", false, {{"DEPTH", depth}});
  data[size_t(SurfaceData::Thickness)] = pipelines.make("render/surface_data_thickness");
  if (auto made = pipelines.result(); !made) return made.error();
  return makeShade();
}

Expected<void> FluidRendererImpl::makeShade() {
  constexpr const char* kFragments[kShades][2] = {{"render/fluid_shade_fragment", "render/fluid_shade_environment_fragment"},
                                                  {"render/fluid_shade_opaque_fragment", "render/fluid_shade_opaque_environment_fragment"},
                                                  {"render/fluid_shade_crests_fragment", "render/fluid_shade_crests_environment_fragment"}};
  const uint32_t fluids = static_cast<uint32_t>(bodies.size());
  for (size_t k = 0; k < kShades; ++k) {
    const bool several = fluids > 1 && Shade(k) != Shade::Opaque;
    const std::string fragment = texelVariant(*device->device, kFragments[k][environment != nullptr], usesTexelReads(*device->device));
    auto drawn = graphicsPipeline(*device->device, {.vertex = "render/fluid_shade_vertex",
                                                    .fragment = fragment,
                                                    .constants = {&fluids, several ? 1u : 0u},
                                                    .colors = {&formats.color, 1},
                                                    .depth = formats.depth,
                                                    .depthCompare = VK_COMPARE_OP_ALWAYS,  // the shader compares in m
                                                    .depthWrite = true});
    if (!drawn) return drawn.error();
    shade[k] = *drawn;
  }
  return {};
}

Expected<void> FluidRendererImpl::setEnvironment(const EnvironmentPicture& picture) {
  auto made = Environment::create(*device->device, picture);
  if (!made) return made.error();
  environment = *std::move(made);
  return makeShade();
}

Expected<void> FluidRendererImpl::setFluids(std::span<const FluidBody> fluids) {
  if (auto ok = checkBodies(fluids); !ok) return ok;
  if (fluids.size() > 1)
    if (auto made = surface.setFluids(*device->device, fluids); !made) return made;
  bodies.assign(fluids.begin(), fluids.end());
  return makeShade();
}

SurfacePush FluidRendererImpl::camera(const FluidState& fluid, const FluidView& view) const {
  SurfacePush push = viewPush(view, fluid.origin);
  push.step = sampleStep(push, fluid.spacing, view.focus_m);
  return push;
}

/// A copy costs less than a pass that reads images, but needs an image that can be copied from, which those of a host need not be.
FluidRendererImpl::SceneCopy FluidRendererImpl::copyScene(Graph& graph, const SceneTargets& targets, bool ownTargets) const {
  const SurfacePush& push = last.push;
  const uint64_t pixels = uint64_t{push.width} * push.height;
  SceneCopy copy{graph.create("fluid scene color", {pixels * 8}), graph.create("fluid scene depth", {pixels * 4})};
  if (!ownTargets) {
    addDispatch(graph, "fluid scene", scene, {last.arguments, kPixelArguments * 4}, push,
                {{"host_color", targets.color}, {"host_depth", targets.depth}, {"scene_color", copy.color}, {"scene_depth", copy.depth}});
    return copy;
  }
  graph.pass("fluid scene", [&](Pass& pass) {
    pass.read(targets.color, Use::CopySource);
    pass.read(targets.depth, Use::CopySource);
    copy.color = pass.write(copy.color, Use::CopyTarget, true);
    copy.depth = pass.write(copy.depth, Use::CopyTarget, true);
    return [targets, copy](Commands& commands) {
      commands.copy(targets.color, copy.color);
      commands.copy(targets.depth, copy.depth);
    };
  });
  return copy;
}

SceneTargets FluidRendererImpl::addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view,
                                      const FluidLook& given, bool ownTargets, BufferRef texels) {
  const FluidLook look = bodies.size() == 1 ? withBody(given, bodies.front()) : given;
  if (fluid.capacity == 0) {
    graph.skipped("fluid shade", "there are no particles");
    return targets;
  }
  if (!accepted(graph, checkTargets(graph, targets, view))) return targets;
  last = surface.addTo(graph, fluid, camera(fluid, view), look.surface, ownTargets, view.focus_m);
  const SurfacePush push = last.push;
  lastScene = copyScene(graph, targets, ownTargets);
  const BufferRef sceneColor = lastScene.color, sceneDepth = lastScene.depth;
  const SurfacePush thick = SurfaceStage::thicknessPush(push, fluid, kThicknessStep);
  BufferRef thickness, normals, back;
  if (look.opaque) {
    graph.skipped(kFluidThickness.pass, "the look is opaque");
    graph.skipped("surface mean normals", "the look is opaque");
    graph.skipped("fluid back", "the look is opaque");
  } else {
    normals = meanNormals.addTo(graph, last);
    const auto of = bodies.size() > 1 ? SurfaceStage::Of::EachFluid : SurfaceStage::Of::All;
    thickness = surface.addThickness(graph, kFluidThickness, fluid, thick, sceneDepth, &last, of);
    back = surface.addBack(graph, last, thick, thickness, sceneDepth, of);
  }
  look::LookRecord values = lookRecord(look, thick, environment.get(), bodies);
  const bool lit = !look.opaque && (look.scattering.x > 0 || look.scattering.y > 0 || look.scattering.z > 0);
  BufferRef sunward;
  if (lit) {
    sunward = crests.addTo(graph, fluid, values.light, last.particles);
    values.crests.x = static_cast<float>(CrestDepths::side(fluid.capacity));
  }
  const BufferRef record = addLook(graph, values);
  graph.pass("fluid shade", [&](Pass& pass) {
    pass.read(last.arguments, Use::Indirect);
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Shade kind = lit ? Shade::Crests : look.opaque ? Shade::Opaque : Shade::Plain;
    const Kernel kernel = bindNamed(pass, shade[static_cast<size_t>(kind)],
                                    {{"look", record},
                                     {"tiles", last.tiles},
                                     {"surface", last.pixels},
                                     {"scene_color", sceneColor},
                                     {"scene_depth", sceneDepth},
                                     {"thickness", thickness},
                                     {"mean_normals", normals},
                                     {"samples", last.samples},
                                     {"back", back},
                                     {"heights", sunward},
                                     {"environment", texels}});
    return [kernel, push, arguments = last.arguments](Commands& commands) {
      commands.viewport(push.left, push.top, push.width, push.height);
      commands.drawIndirect(kernel, arguments, kTileDraw * 4, push);
    };
  });
  return targets;
}

BufferRef FluidRendererImpl::addData(Graph& graph, const FluidState& fluid, const FluidView& view, SurfaceData what, float full,
                                     SurfaceMethod method) {
  const SurfacePush push = camera(fluid, view);
  const uint64_t pixels = uint64_t{push.width} * push.height;
  BufferRef picture = graph.create("surface data", {pixels * 4});
  if (fluid.capacity == 0) {
    addFill(graph, "surface data", {{&picture, 0}});
    return picture;
  }
  last = surface.addTo(graph, fluid, push, method, true, view.focus_m);
  const SurfacePush thick = SurfaceStage::thicknessPush(push, fluid, kThicknessStep);
  BufferRef thickness;
  if (what == SurfaceData::Thickness) thickness = surface.addThickness(graph, kFluidThickness, fluid, thick, {}, &last);
  addDispatch(graph, "surface data", data[static_cast<size_t>(what)], divideUp(pixels, kSurfaceGroup), DataPush{thick, full},
              {{"surface", last.pixels}, {"thickness", thickness}, {"picture", picture}});
  return picture;
}

Expected<FluidRenderer> FluidRenderer::create(Device& device, const TargetFormats& formats) {
  auto impl = std::make_unique<FluidRendererImpl>();
  if (auto ok = impl->create(device, formats); !ok) return ok.error();
  return FluidRenderer(std::move(impl));
}

FluidRenderer::FluidRenderer(std::unique_ptr<FluidRendererImpl> impl) : impl_(std::move(impl)) {}
FluidRenderer::~FluidRenderer() = default;
FluidRenderer::FluidRenderer(FluidRenderer&&) noexcept = default;
FluidRenderer& FluidRenderer::operator=(FluidRenderer&&) noexcept = default;

Expected<void> FluidRenderer::setEnvironment(const EnvironmentPicture& picture) { return impl_->setEnvironment(picture); }

Expected<void> FluidRenderer::setFluids(std::span<const FluidBody> fluids) { return impl_->setFluids(fluids); }

Expected<void> FluidRenderer::check(const FluidView& view) { return checkView(view); }

SceneTargets FluidRenderer::addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view,
                                  const FluidLook& look) {
  for (const auto& check : {checkView(view), checkMethod(look.surface), checkFluid(graph, fluid), checkLook(look)})
    if (!accepted(graph, check)) return targets;
  const bool drawn = impl_->environment && fluid.capacity > 0;
  return impl_->addTo(graph, fluid, targets, view, look, false, drawn ? impl_->environment->addTo(graph) : BufferRef{});
}

BufferRef FluidRenderer::addData(Graph& graph, const FluidState& fluid, const FluidView& view, SurfaceData data, float full,
                                 SurfaceMethod method) {
  for (const auto& check : {checkView(view), checkMethod(method), checkFluid(graph, fluid), checkData(data)})
    if (!accepted(graph, check)) return {};
  return impl_->addData(graph, fluid, view, data, full, method);
}

}  // namespace rill
