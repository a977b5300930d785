#include "rill/fluid_renderer.hpp"

#include <cmath>
#include <cstring>

#include "core/words.hpp"
#include "graph/graph_impl.hpp"
#include "graph/step.hpp"
#include "render/fluid_renderer_impl.hpp"
#include "render/view_push.hpp"
#include "sort/dispatches.hpp"

namespace rill {

using namespace surface;

look::LookRecord lookRecord(const FluidLook& look, const SurfacePush& thickness, const Environment* environment) {
  look::LookRecord record{};
  record.absorption = {look.absorption.x, look.absorption.y, look.absorption.z, look.refraction_index};
  record.scatter = {look.scatter.x, look.scatter.y, look.scatter.z, look.opaque ? 1.0f : 0.0f};
  const Float3& s = look.to_sun;
  const float size = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
  record.light = size > 0 ? Float4{s.x / size, s.y / size, s.z / size, look.sun} : Float4{0, 1, 0, look.sun};
  record.finish = {look.highlight, static_cast<float>(thickness.step), thickness.unit, look.aeration};
  if (environment) {
    const Float3 above = environment->above(), below = environment->below();
    record.above = {above.x, above.y, above.z, static_cast<float>(environment->width())};
    record.below = {below.x, below.y, below.z, static_cast<float>(environment->height())};
  }
  return record;
}

BufferRef addLook(Graph& graph, const look::LookRecord& record) {
  BufferRef buffer = graph.create("fluid look", {sizeof record});
  graph.pass("fluid look", [&](Pass& pass) {
    buffer = pass.write(buffer, Use::CopyTarget, true);
    return [buffer, record](Commands& commands) { commands.update(buffer, std::as_bytes(std::span(&record, 1))); };
  });
  return buffer;
}

Expected<void> FluidRendererImpl::create(Device& host, const TargetFormats& targets) {
  if (targets.color == VK_FORMAT_UNDEFINED || hasDepth(targets.color))
    return Error{ErrorKind::BadInput, "TargetFormats::color is " + std::to_string(targets.color) + "; expected a VkFormat of colors"};
  if (!hasDepth(targets.depth))
    return Error{ErrorKind::BadInput,
                 "TargetFormats::depth is " + std::to_string(targets.depth) + "; expected a VkFormat that holds depth"};
  device = &host;
  formats = targets;
  auto stage = SurfaceStage::create(host);
  if (!stage) return stage.error();
  surface = *stage;
  auto mean = MeanFaces::create(host);
  if (!mean) return mean.error();
  faces = *mean;
  using enum BindingKind;
  static constexpr BindingKind kScene[] = {SampledImage, SampledImage, Storage, Storage};
  static constexpr BindingKind kData[] = {Storage, Storage, Storage};
  auto made = computePipeline(host, {.shader = "render/surface_scene", .bindings = kScene, .pushConstantBytes = sizeof(SurfacePush)});
  if (!made) return made.error();
  scene = *made;
  for (uint32_t what = 0; what < 3; ++what) {
    const uint32_t constants[] = {what};
    made = computePipeline(host,
                           {.shader = "render/analysis", .bindings = kData, .pushConstantBytes = sizeof(DataPush), .constants = constants});
    if (!made) return made.error();
    data[what] = *made;
  }
  return makeShade();
}

Expected<void> FluidRendererImpl::makeShade() {
  using enum BindingKind;
  static constexpr BindingKind kShade[] = {Uniform, Storage, Storage, Storage, Storage, Storage, Storage, Storage, Storage};
  auto drawn =
      graphicsPipeline(*device, {.vertex = "render/fluid_shade_vertex",
                                 .fragment = environment ? "render/fluid_shade_environment_fragment" : "render/fluid_shade_fragment",
                                 .bindings = std::span(kShade).first(environment ? 9 : 8),
                                 .pushConstantBytes = sizeof(SurfacePush),
                                 .colors = {&formats.color, 1},
                                 .depth = formats.depth,
                                 .depthCompare = VK_COMPARE_OP_ALWAYS,  // the shader compares in m
                                 .depthWrite = true});
  if (!drawn) return drawn.error();
  shade = *drawn;
  return {};
}

Expected<void> FluidRendererImpl::setEnvironment(const EnvironmentPicture& picture) {
  auto made = Environment::create(*device, picture);
  if (!made) return made.error();
  environment = *std::move(made);
  return makeShade();
}

bool FluidRendererImpl::possible(Graph& graph, const FluidState& fluid, const FluidView& view, SurfaceMethod method) {
  const auto mistake = [&](std::string what) {
    graph.impl().fail(std::move(what));
    return false;
  };
  if (auto ok = checkView(view); !ok) return mistake(ok.error().message);
  if (size_t(method) > size_t(SurfaceMethod::NarrowRange)) return mistake(std::to_string(unsigned(method)) + " is no SurfaceMethod");
  if (fluid.count == 0) return true;
  if (fluid.count > SurfaceStage::kMaxParticles)
    return mistake("a fluid of " + std::to_string(fluid.count) + " particles: at most " + std::to_string(SurfaceStage::kMaxParticles) +
                   " can be drawn");
  if (!(fluid.spacing > 0 && std::isfinite(fluid.spacing)))
    return mistake("FluidState::spacing is " + shortestNumber(fluid.spacing) + "; expected a length above 0 (m)");
  for (const double v : fluid.origin)
    if (!std::isfinite(v)) return mistake("FluidState::origin is " + shortestNumber(v) + "; expected finite numbers (m)");
  const auto& resources = graph.impl().resources;
  const BufferRef position = fluid.position;
  if (position.index >= resources.size() || resources[position.index].isImage) return true;  // the pass that reads it says so
  if (const uint64_t bytes = resources[position.index].size; bytes < uint64_t{fluid.count} * 16)
    return mistake("FluidState::position has " + std::to_string(bytes) + " bytes; expected 16 for each of its " +
                   std::to_string(fluid.count) + " particles");
  return true;
}

bool FluidRendererImpl::possible(Graph& graph, const FluidLook& look) {
  const auto refused = [&](const char* what, float value, const char* expected) {
    graph.impl().fail("FluidLook::" + std::string(what) + " is " + shortestNumber(double{value}) + "; expected " + expected);
    return false;
  };
  if (!(look.refraction_index >= 1 && look.refraction_index <= 10)) return refused("refraction_index", look.refraction_index, "1 to 10");
  if (!(look.aeration >= 0 && look.aeration <= 1)) return refused("aeration", look.aeration, "0 to 1");
  return true;
}

bool FluidRendererImpl::within(Graph& graph, const SceneTargets& targets, const FluidView& view) {
  const auto& resources = graph.impl().resources;
  for (const ImageRef target : {targets.color, targets.depth}) {
    if (target.index >= resources.size() || !resources[target.index].isImage) continue;  // the pass that reads it says so
    const ResourceData& image = resources[target.index];
    if (uint64_t{view.x} + view.width <= image.width() && uint64_t{view.y} + view.height <= image.height()) continue;
    graph.impl().fail("the fluid's viewport of " + std::to_string(view.width) + "x" + std::to_string(view.height) + " pixels at " +
                      std::to_string(view.x) + ", " + std::to_string(view.y) + " does not lie within a target of " +
                      std::to_string(image.width()) + "x" + std::to_string(image.height()));
    return false;
  }
  return true;
}

SurfacePush FluidRendererImpl::camera(const FluidState& fluid, const FluidView& view) const {
  SurfacePush push = viewPush(view, fluid.origin);
  push.step = sampleStep(push, fluid.spacing, view.focus_m);
  return push;
}

SceneTargets FluidRendererImpl::addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view,
                                      const FluidLook& look, bool whole, BufferRef texels) {
  if (fluid.count == 0) {
    graph.skipped("fluid shade", "there are no particles");
    return targets;
  }
  if (!within(graph, targets, view)) return targets;
  last = surface.addTo(graph, fluid, camera(fluid, view), look.surface, whole, view.focus_m);
  const SurfacePush push = last.push;
  const uint64_t pixels = uint64_t{push.width} * push.height;
  BufferRef sceneColor = graph.create("fluid scene color", {pixels * 8}), sceneDepth = graph.create("fluid scene depth", {pixels * 4});
  addStep(graph, "fluid scene", scene, {sampled(targets.color), sampled(targets.depth), fresh(sceneColor), fresh(sceneDepth)},
          StepGroups(last.arguments, kPixelArguments), push);
  const SurfacePush thick = SurfaceStage::thicknessPush(push, fluid, kThicknessStep);
  BufferRef thickness, bend;
  if (look.opaque) {
    graph.skipped(kFluidThickness.pass, "the look is opaque");
    graph.skipped("surface faces", "the look is opaque");
    thickness = bend = last.tiles;  // bound, never read
  } else {
    bend = faces.addTo(graph, last);
    thickness = surface.addThickness(graph, kFluidThickness, fluid, thick, sceneDepth, &last.counters);
  }
  const BufferRef record = addLook(graph, lookRecord(look, thick, environment.get()));
  graph.pass("fluid shade", [&](Pass& pass) {
    pass.read(record, Use::DrawUniform);
    const ResourceRef bound[] = {record, last.tiles, last.pixels, thickness, sceneColor, sceneDepth, bend, last.samples, texels};
    const size_t count = environment ? 9 : 8;
    for (size_t k = 1; k < count; ++k) pass.read(BufferRef{bound[k]}, Use::DrawRead);
    pass.read(last.arguments, Use::Indirect);
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel = pass.kernel(shade, std::span(bound).first(count));
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
  if (fluid.count == 0) {
    addFill(graph, "surface data", {{&picture, 0}});
    return picture;
  }
  last = surface.addTo(graph, fluid, push, method, true, view.focus_m);
  const SurfacePush thick = SurfaceStage::thicknessPush(push, fluid, kThicknessStep);
  BufferRef thickness = last.tiles;  // bound, never read
  if (what == SurfaceData::Thickness) thickness = surface.addThickness(graph, kFluidThickness, fluid, thick, {}, &last.counters);
  addStep(graph, "surface data", data[static_cast<size_t>(what)], {reads(last.pixels), reads(thickness), fresh(picture)},
          divideUp(pixels, kSurfaceGroup), DataPush{thick, full});
  return picture;
}

Expected<std::unique_ptr<FluidRenderer>> FluidRenderer::create(Device& device, const TargetFormats& formats) {
  auto impl = std::make_unique<FluidRendererImpl>();
  if (auto ok = impl->create(device, formats); !ok) return ok.error();
  return std::unique_ptr<FluidRenderer>(new FluidRenderer(std::move(impl)));
}

FluidRenderer::FluidRenderer(std::unique_ptr<FluidRendererImpl> impl) : impl_(std::move(impl)) {}
FluidRenderer::~FluidRenderer() = default;

Expected<void> FluidRenderer::setEnvironment(const EnvironmentPicture& picture) { return impl_->setEnvironment(picture); }

Expected<void> FluidRenderer::check(const FluidView& view) { return checkView(view); }

SceneTargets FluidRenderer::addTo(Graph& graph, const FluidState& fluid, SceneTargets targets, const FluidView& view,
                                  const FluidLook& look) {
  if (!FluidRendererImpl::possible(graph, fluid, view, look.surface) || !FluidRendererImpl::possible(graph, look)) return targets;
  const bool drawn = impl_->environment && fluid.count > 0;
  return impl_->addTo(graph, fluid, targets, view, look, false, drawn ? impl_->environment->addTo(graph) : BufferRef{});
}

BufferRef FluidRenderer::addData(Graph& graph, const FluidState& fluid, const FluidView& view, SurfaceData data, float full,
                                 SurfaceMethod method) {
  if (!FluidRendererImpl::possible(graph, fluid, view, method)) return {};
  if (size_t(data) > size_t(SurfaceData::Thickness)) {
    graph.impl().fail(std::to_string(unsigned(data)) + " is no SurfaceData");
    return {};
  }
  return impl_->addData(graph, fluid, view, data, full, method);
}

}  // namespace rill
