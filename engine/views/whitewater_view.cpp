#include "views/whitewater_view.hpp"

#include <span>
#include <string>

#include "gpu/module_pipelines.hpp"
#include "gpu/texel_reads.hpp"
#include "graph/shader_pass.hpp"
#include "sort/dispatches.hpp"

namespace rill {

using surface::SurfacePush;

Expected<WhitewaterView> WhitewaterView::create(Device& device, const TargetFormats& formats, bool environment) {
  WhitewaterView out;
  const bool texels = usesTexelReads(device);
  ModulePipelines pipelines(device);
  out.splat_ = pipelines.make("views/whitewater_splat", texels);
  if (auto made = pipelines.result(); !made) return made.error();
  const std::string fragment =
      texelVariant(device, environment ? "views/whitewater_blend_environment_fragment" : "views/whitewater_blend_fragment", texels);
  auto blend = graphicsPipeline(device, {.vertex = "views/scenery_ground_vertex",
                                         .fragment = fragment,
                                         .colors = {&formats.color, 1},
                                         .depth = formats.depth,
                                         .depthCompare = VK_COMPARE_OP_ALWAYS,
                                         .depthWrite = false,
                                         .blend = Blend::Premultiplied});
  if (!blend) return blend.error();
  out.blend_ = *blend;
  return out;
}

BufferRef WhitewaterView::addDots(Graph& graph, const Input& input, const SurfacePush& view, const WhitewaterExposure& exposure) const {
  const Double3& turn = exposure.turn;
  const double x = exposure.about.x - input.origin.x, y = exposure.about.y - input.origin.y, z = exposure.about.z - input.origin.z;
  const auto number = [](double value) { return static_cast<float>(value); };
  const WhiteExposure values{.size = number(exposure.size),
                             .seconds = number(exposure.seconds),
                             .driftX = number(turn.z * y - turn.y * z),
                             .driftY = number(turn.x * z - turn.z * x),
                             .driftZ = number(turn.y * x - turn.x * y),
                             .turnX = number(turn.x),
                             .turnY = number(turn.y),
                             .turnZ = number(turn.z)};
  BufferRef record = graph.create("whitewater exposure", {sizeof values});
  graph.pass("whitewater exposure", [&](Pass& pass) {
    record = pass.write(record, Use::CopyTarget, true);
    return [record, values](Commands& commands) { commands.update(record, std::as_bytes(std::span(&values, 1))); };
  });
  BufferRef dots = graph.create("whitewater dots", {uint64_t{view.width} * view.height * kPixelBytes});
  addFill(graph, "whitewater dots clear", {{&dots, 0}});
  addDispatch(graph, "whitewater splat", splat_, divideUp(input.white.room, kWhiteSplatGroup), view,
              {{"look", std::as_const(input.look)},
               {"exposure", std::as_const(record)},
               {"place", std::as_const(input.white.place)},
               {"motion", std::as_const(input.white.motion)},
               {"counts", std::as_const(input.white.counts)},
               {"surface", std::as_const(input.pixels)},
               {"scene_depth", std::as_const(input.scene)},
               {"dots", dots}});
  return dots;
}

SceneTargets WhitewaterView::addTo(Graph& graph, const Input& input, SceneTargets targets, const SurfacePush& view, BufferRef environment,
                                   const WhitewaterExposure& exposure) const {
  const BufferRef dots = addDots(graph, input, view, exposure);
  graph.pass("whitewater blend", [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel =
        bindNamed(pass, blend_, {{"look", std::as_const(input.look)}, {"dots", dots}, {"environment", std::as_const(environment)}});
    return [kernel, view](Commands& commands) {
      commands.viewport(view.left, view.top, view.width, view.height);
      commands.draw(kernel, 3, 1, view);
    };
  });
  return targets;
}

}  // namespace rill
