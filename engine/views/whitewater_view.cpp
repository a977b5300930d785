#include "views/whitewater_view.hpp"

#include "gpu/module_pipelines.hpp"
#include "graph/shader_pass.hpp"
#include "render/look_record.hpp"
#include "sort/dispatches.hpp"

namespace rill {

using surface::SurfacePush;

Expected<WhitewaterView> WhitewaterView::create(Device& device, const TargetFormats& formats, bool environment) {
  WhitewaterView out;
  ModulePipelines pipelines(device);
  out.scene_ = pipelines.make("views/whitewater_scene");
  out.splat_ = pipelines.make("views/whitewater_splat");
  if (auto made = pipelines.result(); !made) return made.error();
  auto blend =
      graphicsPipeline(device, {.vertex = "views/scenery_ground_vertex",
                                .fragment = environment ? "views/whitewater_blend_environment_fragment" : "views/whitewater_blend_fragment",
                                .colors = {&formats.color, 1},
                                .depth = formats.depth,
                                .depthCompare = VK_COMPARE_OP_ALWAYS,
                                .depthWrite = false,
                                .blend = Blend::Premultiplied});
  if (!blend) return blend.error();
  out.blend_ = *blend;
  return out;
}

BufferRef WhitewaterView::addScene(Graph& graph, ImageRef depth, const SurfacePush& view) const {
  const uint64_t pixels = uint64_t{view.width} * view.height;
  BufferRef scene = graph.create("whitewater scene depth", {pixels * 4});
  addDispatch(graph, "whitewater scene", scene_, divideUp(pixels, surface::kSurfaceGroup), view,
              {{"host_depth", std::as_const(depth)}, {"scene_depth", scene}});
  return scene;
}

SceneTargets WhitewaterView::addTo(Graph& graph, const WhitewaterState& white, SceneTargets targets, const SurfacePush& view,
                                   const look::LookRecord& look, BufferRef scene, BufferRef pixels, BufferRef environment,
                                   double size) const {
  struct SplatPush {
    SurfacePush view;
    float size;
  };
  const BufferRef record = addLook(graph, look);
  BufferRef dots = graph.create("whitewater dots", {uint64_t{view.width} * view.height * kPixelBytes});
  addFill(graph, "whitewater dots clear", {{&dots, 0}});
  addDispatch(graph, "whitewater splat", splat_, divideUp(white.room, kWhiteSplatGroup), SplatPush{view, static_cast<float>(size)},
              {{"look", record},
               {"place", std::as_const(white.place)},
               {"motion", std::as_const(white.motion)},
               {"counts", std::as_const(white.counts)},
               {"surface", std::as_const(pixels)},
               {"scene_depth", std::as_const(scene)},
               {"dots", dots}});
  graph.pass("whitewater blend", [&](Pass& pass) {
    targets.color = pass.write(targets.color, Use::ColorTarget);
    targets.depth = pass.write(targets.depth, Use::DepthTarget);
    const Kernel kernel =
        bindNamed(pass, blend_, {{"look", record}, {"dots", std::as_const(dots)}, {"environment", std::as_const(environment)}});
    return [kernel, view](Commands& commands) {
      commands.viewport(view.left, view.top, view.width, view.height);
      commands.draw(kernel, 3, 1, view);
    };
  });
  return targets;
}

}  // namespace rill
